use super::error::{CaseError, Place};
use super::suggest::nearest;
use serde::de::DeserializeOwned;
use std::path::{Path, PathBuf};
use toml::de::{DeArray, DeTable, DeValue};
use toml::{Spanned, Table, Value};

/// What a case is a case of.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Kind {
    /// `[piston]`.
    Piston,
    /// `[flow]`.
    Flow,
}

/// A case file as text, with what the command line lays over it.
///
/// Values come, in this order, from `--set`, from the `[quick]` table when asked for, and from the file
/// itself; [`place`](Self::place) tells which, so that an error can point at the line to mend.
#[derive(Debug)]
pub(super) struct Document {
    path: PathBuf,
    text: String,
    quick: bool,
    settings: Vec<(String, Value)>,
}

impl Document {
    pub(super) fn new(
        path: &Path,
        text: String,
        quick: bool,
        settings: &[String],
    ) -> Result<Self, CaseError> {
        let settings = settings.iter().map(|s| parse_setting(s)).collect::<Result<_, _>>()?;
        Ok(Self { path: path.to_owned(), text, quick, settings })
    }

    /// Which of `[piston]` and `[flow]` there is.
    pub(super) fn kind(&self) -> Result<Kind, CaseError> {
        let mut table: Table = toml::from_str(&self.text).map_err(|e| self.syntax(&e))?;
        self.apply_settings(&mut table)?;
        let wrong = |found| Err(CaseError::Kind { path: self.path.clone(), found });
        match (table.contains_key("piston"), table.contains_key("flow")) {
            (true, false) => Ok(Kind::Piston),
            (false, true) => Ok(Kind::Flow),
            (true, true) => wrong("both"),
            (false, false) => wrong("neither"),
        }
    }

    /// The file with all overrides applied, keys checked, values not yet.
    pub(super) fn case_file<F: DeserializeOwned>(&self) -> Result<F, CaseError> {
        let mut table: Table = toml::from_str(&self.text).map_err(|e| self.syntax(&e))?;
        let quick = match table.remove("quick") {
            Some(Value::Table(quick)) => quick,
            None => Table::new(),
            Some(other) => return Err(self.quick_not_a_table(&other)),
        };
        let mut quick_table = table.clone();
        overlay(&mut quick_table, quick);
        // A slip in [quick] is told even when nobody asks for it.
        let mut quick_file = quick_table.clone();
        self.apply_settings(&mut quick_file)?;
        let quick_file = F::deserialize(Value::Table(quick_file));
        if self.quick {
            return quick_file.map_err(|e| self.overridden::<F>(&e));
        }
        let file = if self.settings.is_empty() {
            toml::from_str(&self.text).map_err(|e| self.syntax(&e))?
        } else {
            self.apply_settings(&mut table)?;
            F::deserialize(Value::Table(table)).map_err(|e| self.overridden::<F>(&e))?
        };
        quick_file.map(|_| file).map_err(|e| self.overridden::<F>(&e))
    }

    fn apply_settings(&self, table: &mut Table) -> Result<(), CaseError> {
        for (key, value) in &self.settings {
            set(table, key, value.clone())?;
            // Each says how many modes: the one that is set stands for the other.
            let other = match key.as_str() {
                "pod.energy" => "modes",
                "pod.modes" => "energy",
                _ => continue,
            };
            if let Some(Value::Table(pod)) = table.get_mut("pod") {
                pod.remove(other);
            }
        }
        Ok(())
    }

    /// Where the value of `key`, such as `piston.mass`, was written.
    pub(super) fn place(&self, key: &str) -> Place {
        if let Some((set, value)) = self.settings.iter().rev().find(|(k, _)| covers(k, key)) {
            return Place::Setting(format!("{set}={value}"));
        }
        let quick = self.quick.then(|| self.line(&format!("quick.{key}"))).flatten();
        match quick.or_else(|| self.line(key)) {
            Some(line) => Place::Line(self.path.clone(), line),
            None => Place::Default(self.path.clone()),
        }
    }

    /// Where `key` was written, or else the section that is nearest around it.
    pub(super) fn place_around(&self, key: &str) -> Place {
        match (self.place(key), key.rsplit_once('.')) {
            (Place::Default(_), Some((section, _))) => self.place_around(section),
            (place, _) => place,
        }
    }

    fn has_quick(&self) -> bool {
        self.line("quick").is_some()
    }

    /// The line of `key`, or of the value that holds it; `rom.models.2.sigma` and `bodies.disc.mass` go into lists.
    fn line(&self, key: &str) -> Option<usize> {
        let root = DeTable::parse(&self.text).ok()?;
        let (first, rest) = key.split_once('.').map_or((key, None), |(f, r)| (f, Some(r)));
        let mut value = root.get_ref().get(first)?;
        for part in rest.into_iter().flat_map(|r| r.split('.')) {
            value = match value.get_ref() {
                DeValue::Table(table) => table.get(part)?,
                DeValue::Array(list) => match entry(list, part) {
                    Some(entry) => entry,
                    None => break,
                },
                _ => break,
            };
        }
        Some(self.line_at(value.span().start))
    }

    /// The line of `key` where neither `[quick]` nor a setting may stand for it.
    fn line_of_base(&self, key: &str) -> Option<usize> {
        let section = key.split('.').next().unwrap_or_default();
        let set = self.settings.iter().any(|(set, _)| set.split('.').next() == Some(section));
        let over = set || self.line(&format!("quick.{section}")).is_some();
        if over { None } else { self.line(key) }
    }

    fn line_at(&self, offset: usize) -> usize {
        1 + self.text[..offset].matches('\n').count()
    }

    fn syntax(&self, error: &toml::de::Error) -> CaseError {
        let line = error.span().map(|s| self.line_at(s.start));
        CaseError::Syntax {
            path: self.path.clone(),
            line,
            message: plain(&error.to_string()),
            help: help(error.message()),
        }
    }

    fn overridden<F: DeserializeOwned>(&self, error: &toml::de::Error) -> CaseError {
        // The file may be wrong by itself: then its own line is the better answer.
        let own = toml::from_str::<F>(&self.text).err();
        if let Some(own) = own.filter(|own| !self.quick && own.message() == error.message()) {
            return self.syntax(&own);
        }
        // Too long a list is noticed only here, where the parser knows the key and not the line.
        let message = error.to_string();
        let key = message.split_once("in `").and_then(|(_, rest)| rest.split('`').next());
        let key = key.map(|key| key.replace('[', ".").replace(']', ""));
        if let Some(line) = key.and_then(|key| self.line_of_base(&key)) {
            let (path, help) = (self.path.clone(), help(error.message()));
            return CaseError::Syntax { path, line: Some(line), message: plain(&message), help };
        }
        let settings = self.settings.iter().map(|(k, v)| format!("--set {k}={v}"));
        let quick = self.has_quick().then(|| "[quick]".to_owned());
        CaseError::Override {
            path: self.path.clone(),
            overrides: quick.into_iter().chain(settings).collect::<Vec<_>>().join(" "),
            message: plain(&error.to_string()),
            help: help(error.message()),
        }
    }

    fn quick_not_a_table(&self, value: &Value) -> CaseError {
        CaseError::Value {
            place: self.place("quick"),
            key: "quick".into(),
            value: value.to_string(),
            expected: "a table of overrides, such as [quick] with mesh.cells = 100".into(),
        }
    }
}

/// Whether a setting of `set` decides the value of `key`.
fn covers(set: &str, key: &str) -> bool {
    key.strip_prefix(set).is_some_and(|rest| rest.is_empty() || rest.starts_with('.'))
}

fn parse_setting(text: &str) -> Result<(String, Value), CaseError> {
    let bad = || CaseError::Setting { text: text.to_owned() };
    let (key, value) = text.split_once('=').ok_or_else(bad)?;
    let key = key.trim();
    let mut parts = key.split('.').map(str::trim);
    if parts.clone().any(str::is_empty) || parts.next() == Some("quick") {
        return Err(bad());
    }
    let value = value.trim();
    // Whatever is not a TOML value is meant as a word: --set time.scheme=bdf2.
    let parsed =
        toml::from_str::<Table>(&format!("v = {value}")).ok().and_then(|mut t| t.remove("v"));
    Ok((key.to_owned(), parsed.unwrap_or_else(|| Value::String(value.to_owned()))))
}

/// Lays the sections of `over` over those of `table`, key by key; a value replaces a value whole.
fn overlay(table: &mut Table, over: Table) {
    for (name, value) in over {
        match (table.get_mut(&name), value) {
            (Some(Value::Table(section)), Value::Table(keys)) => section.extend(keys),
            (_, value) => {
                table.insert(name, value);
            }
        }
    }
}

/// What stands in a list at a number, counted from 0, or under a name.
fn entry<'a, 'i>(list: &'a DeArray<'i>, part: &str) -> Option<&'a Spanned<DeValue<'i>>> {
    let name = |value: &&Spanned<DeValue<'i>>| {
        value.get_ref().get("name").and_then(|name| name.get_ref().as_str()) == Some(part)
    };
    let number = || part.parse().ok().and_then(|k: usize| list.get(k));
    list.iter().find(name).or_else(number)
}

/// Puts a value under a key, such as `piston.mass`, or `bodies.disc.mass` in a list of tables that have names.
fn set(table: &mut Table, key: &str, value: Value) -> Result<(), CaseError> {
    let mut parts = key.split('.');
    let first = parts.next().unwrap_or_default();
    let mut place = table.entry(first).or_insert_with(|| Value::Table(Table::new()));
    let mut path = first.to_owned();
    for part in parts {
        place = match place {
            Value::Table(table) => table.entry(part).or_insert_with(|| Value::Table(Table::new())),
            Value::Array(list) => {
                let known = list.iter().filter_map(|entry| named(entry).map(str::to_owned));
                let known = known.collect();
                let found = list.iter_mut().find(|entry| named(entry) == Some(part));
                found.ok_or_else(|| CaseError::Entry {
                    key: key.to_owned(),
                    list: path.clone(),
                    name: part.to_owned(),
                    known,
                })?
            }
            _ => return Err(CaseError::Setting { text: key.to_owned() }),
        };
        path = format!("{path}.{part}");
    }
    *place = value;
    Ok(())
}

/// The name of a table in a list.
fn named(entry: &Value) -> Option<&str> {
    entry.get("name")?.as_str()
}

/// A parser's message in words of the case file, not of the program.
fn plain(message: &str) -> String {
    let mut text = message.trim_end().replace("expected f64", "expected a number");
    text = text.replace("expected usize", "expected a whole number");
    text = text.replace(
        "invalid type: map, expected a sequence",
        "one table, expected a list of tables: double the brackets, [[ ]]",
    );
    while let Some((before, rest)) = text.split_once("struct ") {
        let end = rest.find(|c: char| !c.is_alphanumeric()).unwrap_or(rest.len());
        text = format!("{before}a table of keys{}", &rest[end..]);
    }
    text
}

/// "did you mean", read from serde's own list of what it expected.
fn help(message: &str) -> String {
    let quoted: Vec<&str> = message.split('`').skip(1).step_by(2).collect();
    match quoted.split_first() {
        Some((found, known)) if message.starts_with("unknown") => match nearest(found, known) {
            Some(word) => format!("did you mean `{word}`?"),
            None => "take one of those that are named there".into(),
        },
        _ => "`lumley cases` lists case files that work; `lumley cases NAME` prints one".into(),
    }
}
