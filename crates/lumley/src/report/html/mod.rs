//! The page of a report: title, key facts, contents, sections with text, tables and figures.

mod player;
mod table;

use std::fmt::Write;

pub(super) use player::{controls, rounded, script, spread};
pub use table::Table;

use super::figure::{self, Figure};
use super::markup::{escape, html};

/// A finished report: strings, for the caller to write where it wants.
///
/// ```
/// use lumley::report::PodReport;
///
/// let report = PodReport { source: "wake.npy".into(), ..PodReport::default() }.render();
/// assert!(report.page.starts_with("<!doctype html>"));
/// assert!(report.figures.iter().all(|(name, _)| name.ends_with(".svg")));
/// ```
#[derive(Debug, Clone, PartialEq)]
pub struct Report {
    /// The self-contained page, `report.html`.
    pub page: String,
    /// Name and text of every figure as a file of its own.
    pub figures: Vec<(String, String)>,
}

/// A page under construction; texts are in markup.
///
/// ```
/// use lumley::report::html::{Page, Section};
///
/// let report = Page::new("Piston", "Burgers flow and a spring")
///     .fact("0.29 %", "error of the mapped model")
///     .section(Section::new("Energies").paragraph("Six modes hold *almost* everything."))
///     .render();
/// assert!(report.page.contains("<i>almost</i>"));
/// ```
#[derive(Debug, Clone)]
pub struct Page {
    title: String,
    summary: String,
    facts: Vec<(String, String)>,
    sections: Vec<Section>,
}

impl Page {
    /// A page with a title and one line that sums it up.
    pub fn new(title: &str, summary: &str) -> Self {
        Self {
            title: title.into(),
            summary: summary.into(),
            facts: Vec::new(),
            sections: Vec::new(),
        }
    }

    /// Adds a key number and what it is.
    #[must_use]
    pub fn fact(mut self, value: &str, meaning: &str) -> Self {
        self.facts.push((value.into(), meaning.into()));
        self
    }

    /// Adds key numbers, each with what it is.
    #[must_use]
    pub fn facts(self, facts: impl IntoIterator<Item = (String, String)>) -> Self {
        facts.into_iter().fold(self, |page, (value, meaning)| page.fact(&value, &meaning))
    }

    /// Adds a section.
    #[must_use]
    pub fn section(mut self, section: Section) -> Self {
        self.sections.push(section);
        self
    }

    /// The page and the files of its figures.
    pub fn render(&self) -> Report {
        let title = escape(&super::markup::plain(&self.title));
        let mut page = format!(
            "<!doctype html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n\
             <meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n\
             <meta name=\"color-scheme\" content=\"light dark\">\n<title>{title}</title>\n\
             <style>\n{}{}</style>\n</head>\n<body>\n",
            figure::STYLE,
            include_str!("page.css"),
        );
        self.write_header(&mut page);
        let mut figures = 0;
        for (k, section) in self.sections.iter().enumerate() {
            section.write(&mut page, k + 1, &mut figures);
        }
        page += "</body>\n</html>\n";
        let figures = self.sections.iter().flat_map(Section::figures).map(Figure::file).collect();
        Report { page, figures }
    }

    fn write_header(&self, page: &mut String) {
        let (title, summary) = (html(&self.title), html(&self.summary));
        let _ = write!(page, "<header>\n<h1>{title}</h1>\n<p>{summary}</p>\n</header>\n");
        if !self.facts.is_empty() {
            *page += "<dl class=\"facts\">\n";
            for (value, meaning) in &self.facts {
                let (value, meaning) = (html(value), html(meaning));
                let _ = writeln!(page, "<div><dt>{meaning}</dt><dd>{value}</dd></div>");
            }
            *page += "</dl>\n";
        }
        *page += "<nav aria-label=\"Contents\"><ol>\n";
        for (k, section) in self.sections.iter().enumerate() {
            let _ = writeln!(page, "<li><a href=\"#s{}\">{}</a></li>", k + 1, html(&section.title));
        }
        *page += "</ol></nav>\n";
    }
}

#[derive(Debug, Clone)]
enum Block {
    Html(String),
    Figure(Box<Figure>),
}

/// A section of a page.
///
/// ```
/// use lumley::report::html::{Section, Table};
///
/// let section = Section::new("Energies")
///     .paragraph("The first mode holds 88 %.")
///     .table(&Table::new(&["mode *i*", "*λ*_{i}"]).row(["1".into(), "0.0062".into()]));
/// # let _ = section;
/// ```
#[derive(Debug, Clone)]
pub struct Section {
    title: String,
    blocks: Vec<Block>,
}

impl Section {
    /// An empty section.
    pub fn new(title: &str) -> Self {
        Self { title: title.into(), blocks: Vec::new() }
    }

    /// Adds a paragraph, in markup.
    #[must_use]
    pub fn paragraph(self, text: &str) -> Self {
        self.raw(&format!("<p>{}</p>", html(text)))
    }

    /// Adds a paragraph that stands out: a warning or a failure.
    #[must_use]
    pub fn warning(self, text: &str) -> Self {
        self.raw(&format!("<p class=\"warning\">{}</p>", html(text)))
    }

    /// Adds a table.
    #[must_use]
    pub fn table(self, table: &Table) -> Self {
        self.raw(&table.html())
    }

    /// Adds `text` as it is, folded away behind `title`.
    #[must_use]
    pub fn details(self, title: &str, text: &str) -> Self {
        let (title, text) = (html(title), escape(text));
        self.raw(&format!("<details><summary>{title}</summary><pre>{text}</pre></details>"))
    }

    /// Adds a figure; the page numbers it.
    #[must_use]
    pub fn figure(mut self, figure: Figure) -> Self {
        self.blocks.push(Block::Figure(Box::new(figure)));
        self
    }

    /// Adds HTML as it is.
    #[must_use]
    pub fn raw(mut self, html: &str) -> Self {
        self.blocks.push(Block::Html(html.into()));
        self
    }

    fn figures(&self) -> impl Iterator<Item = &Figure> {
        self.blocks.iter().filter_map(|block| match block {
            Block::Figure(figure) => Some(&**figure),
            Block::Html(_) => None,
        })
    }

    fn write(&self, page: &mut String, number: usize, figures: &mut usize) {
        let title = html(&self.title);
        let _ = writeln!(page, "<section id=\"s{number}\">\n<h2><span>{number}</span>{title}</h2>");
        for block in &self.blocks {
            match block {
                Block::Html(text) => *page += text,
                Block::Figure(figure) => {
                    *figures += 1;
                    let _ = write!(
                        page,
                        "<figure id=\"{}\">\n<div class=\"scroll\">{}</div>\n<figcaption><b>Figure \
                         {figures}.</b> {}</figcaption>\n</figure>",
                        escape(figure.name()),
                        figure.inline(),
                        html(figure.caption()),
                    );
                }
            }
            page.push('\n');
        }
        *page += "</section>\n";
    }
}
