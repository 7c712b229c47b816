//! Tables of a page.

use crate::report::markup::html;

/// A table: texts on the left, numbers aligned on the right.
///
/// ```
/// use lumley::report::html::Table;
///
/// let table = Table::new(&["model", "Res (%)"])
///     .row(["mapped".into(), "0.29".into()])
///     .row(["penalty".into(), "1.37".into()]);
/// # let _ = table;
/// ```
#[derive(Debug, Clone)]
pub struct Table {
    head: Vec<String>,
    labels: usize,
    rows: Vec<Vec<String>>,
}

impl Table {
    /// A table with these column heads, units included, or none; the first column holds texts.
    pub fn new(head: &[&str]) -> Self {
        Self { head: head.iter().map(ToString::to_string).collect(), labels: 1, rows: Vec::new() }
    }

    /// The first `columns` hold texts.
    #[must_use]
    pub fn labels(mut self, columns: usize) -> Self {
        self.labels = columns;
        self
    }

    /// Adds a row of cells, in markup.
    #[must_use]
    pub fn row(mut self, cells: impl IntoIterator<Item = String>) -> Self {
        self.rows.push(cells.into_iter().collect());
        self
    }

    /// Adds many rows.
    #[must_use]
    pub fn rows(self, rows: impl IntoIterator<Item = Vec<String>>) -> Self {
        rows.into_iter().fold(self, Self::row)
    }

    pub(super) fn html(&self) -> String {
        let line = |tag: &str, cells: &[String]| {
            let cell = |(k, text): (usize, &String)| {
                let class = if k < self.labels { "" } else { " class=\"n\"" };
                format!("<{tag}{class}>{}</{tag}>", html(text))
            };
            format!("<tr>{}</tr>\n", cells.iter().enumerate().map(cell).collect::<String>())
        };
        let head = match self.head.as_slice() {
            [] => String::new(),
            head => format!("<thead>{}</thead>\n", line("th", head)),
        };
        let body: String = self.rows.iter().map(|row| line("td", row)).collect();
        format!("<div class=\"scroll\"><table>\n{head}<tbody>{body}</tbody>\n</table></div>")
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn texts_left_numbers_right_and_markup_read() {
        let html = Table::new(&["*i*", "*λ*"]).row(["<1>".into(), "2".into()]).html();
        assert!(html.contains("<tr><th><i>i</i></th><th class=\"n\"><i>λ</i></th></tr>"));
        assert!(html.contains("<tr><td>&lt;1&gt;</td><td class=\"n\">2</td></tr>"));
    }
}
