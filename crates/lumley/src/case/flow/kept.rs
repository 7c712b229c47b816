use super::{FlowCase, FlowFile, InitialSection};
use std::path::{Path, PathBuf};

/// A case as a run directory keeps it: it needs nothing beside it.
///
/// ```
/// use lumley::case::Case;
/// let text = lumley::cases::find("cavity").expect("a case of lumley's own").text;
/// let Case::Flow(case) = Case::parse("cavity/case.toml".as_ref(), text, true, &[])? else {
///     panic!("it has a [flow]");
/// };
/// let kept = case.kept();
/// assert!(kept.inputs.is_empty() && kept.case.contains("[flow.boundaries.top]"));
/// # Ok::<(), lumley::case::CaseError>(())
/// ```
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Kept {
    /// The case file; the files in it have the names of the copies.
    pub case: String,
    /// The files to copy beside it.
    pub inputs: Vec<InputFile>,
}

/// A file that a case names.
///
/// ```
/// use lumley::case::InputFile;
/// let mesh = InputFile { name: "mesh.msh".into(), path: "meshes/fine.msh".into() };
/// assert_eq!(mesh.name, "mesh.msh");
/// ```
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct InputFile {
    /// The name of its copy beside the case file that is kept.
    pub name: String,
    /// Where it is.
    pub path: PathBuf,
}

impl FlowCase {
    /// The case for the run directory, with the files that it needs there. A run that it starts from is not
    /// copied, its path made absolute.
    ///
    /// # Panics
    /// Never: every checked case is a TOML document.
    pub fn kept(&self) -> Kept {
        let mut file = self.file.clone();
        let mut inputs = Vec::new();
        for (name, written) in named_files(&mut file) {
            let path = self.folder.join(&*written);
            written.clone_from(&name);
            inputs.push(InputFile { name, path });
        }
        if let InitialSection::Run(run) = &mut file.flow.initial {
            *run = absolute(&self.folder.join(&*run));
        }
        let case = toml::to_string(&file).expect("a checked case is plain TOML");
        Kept { case, inputs }
    }
}

/// Every file that the case names, with the name of its copy.
fn named_files(file: &mut FlowFile) -> Vec<(String, &mut String)> {
    let mesh = file.mesh.file.iter_mut().map(|mesh| ("mesh.msh".to_owned(), mesh));
    let inflows = file.flow.boundaries.values_mut().filter_map(|b| b.table.as_mut());
    let inflows = (1..).zip(inflows).map(|(k, table)| (format!("velocity-{k}.csv"), table));
    mesh.chain(inflows).collect()
}

fn absolute(path: &Path) -> String {
    std::path::absolute(path).unwrap_or_else(|_| path.to_owned()).to_string_lossy().into_owned()
}
