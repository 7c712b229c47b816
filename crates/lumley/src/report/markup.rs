//! A line of text with italics, subscripts and superscripts, for HTML and for SVG.
//!
//! `*x*` is italic, `_{F}` a subscript, `^{−3}` a superscript, and a backslash takes the next
//! character as it is. Text that a user wrote goes through [`literal`] first.

/// Where a piece of text stands relative to the line.
#[derive(Debug, Clone, Copy, PartialEq)]
enum Shift {
    None,
    Sub,
    Super,
}

/// A run of characters of one style.
#[derive(Debug, Clone, PartialEq)]
struct Span {
    text: String,
    italic: bool,
    shift: Shift,
}

/// Escapes `text` for XML and HTML, in elements and in attributes; control characters, which XML
/// cannot hold, become the replacement character.
pub fn escape(text: &str) -> String {
    let mut out = String::with_capacity(text.len());
    for c in text.chars() {
        match c {
            '&' => out.push_str("&amp;"),
            '<' => out.push_str("&lt;"),
            '>' => out.push_str("&gt;"),
            '"' => out.push_str("&quot;"),
            '\'' => out.push_str("&#39;"),
            '\n' | '\t' => out.push(c),
            '\u{fffe}' | '\u{ffff}' => out.push('\u{fffd}'),
            c if c.is_control() => out.push('\u{fffd}'),
            c => out.push(c),
        }
    }
    out
}

/// Protects every character of `text` that the markup would read as a command.
pub fn literal(text: &str) -> String {
    let special = |c| matches!(c, '*' | '_' | '^' | '\\' | '}');
    text.chars().fold(String::new(), |mut out, c| {
        if special(c) {
            out.push('\\');
        }
        out.push(c);
        out
    })
}

/// The text without its markup, for places that take plain characters only.
pub(super) fn plain(text: &str) -> String {
    spans(text).into_iter().map(|span| span.text).collect()
}

/// The text as HTML.
pub(super) fn html(text: &str) -> String {
    let mut out = String::new();
    for Span { text, italic, shift } in spans(text) {
        let text = escape(&text);
        let text = if italic { format!("<i>{text}</i>") } else { text };
        let (open, close) = match shift {
            Shift::None => ("", ""),
            Shift::Sub => ("<sub>", "</sub>"),
            Shift::Super => ("<sup>", "</sup>"),
        };
        out.extend([open, &text, close]);
    }
    out
}

/// The text as the content of an SVG `text` element: shifts are `dy` steps, which every viewer
/// knows, unlike `baseline-shift`.
pub(super) fn svg(text: &str) -> String {
    let mut out = String::new();
    let mut level = 0;
    for Span { text, italic, shift } in spans(text) {
        let target = match shift {
            Shift::None => 0,
            Shift::Sub => 3,
            Shift::Super => -5,
        };
        let class = if italic { " class=\"i\"" } else { "" };
        let step = match target - level {
            0 => String::new(),
            step => format!(" dy=\"{step}\""),
        };
        let size = if shift == Shift::None { "" } else { " font-size=\"9\"" };
        level = target;
        let text = escape(&text);
        match (class, step.as_str(), size) {
            ("", "", "") => out += &text,
            _ => out.extend(["<tspan", class, &step, size, ">", &text, "</tspan>"]),
        }
    }
    out
}

/// Width of the text in a sans-serif face, in units of the font size (an estimate to lay out by).
pub(super) fn width(text: &str) -> f64 {
    let em = |c| match c {
        'i' | 'j' | 'l' | 't' | 'f' | '.' | ',' | ' ' | '(' | ')' | '|' | '\'' | ':' => 0.33,
        'm' | 'w' | 'M' | 'W' | '%' => 0.9,
        c if c.is_uppercase() => 0.7,
        _ => 0.58,
    };
    let scale = |shift| if shift == Shift::None { 1.0 } else { 0.75 };
    spans(text).iter().map(|s| scale(s.shift) * s.text.chars().map(em).sum::<f64>()).sum()
}

/// Reads the markup; a mark without its partner is an ordinary character or closes at the end.
fn spans(text: &str) -> Vec<Span> {
    let mut out: Vec<Span> = Vec::new();
    let (mut italic, mut shift) = (false, Shift::None);
    let mut characters = text.chars().peekable();
    while let Some(c) = characters.next() {
        let c = match c {
            '*' => {
                italic = !italic;
                continue;
            }
            '_' | '^' if characters.next_if_eq(&'{').is_some() => {
                shift = if c == '_' { Shift::Sub } else { Shift::Super };
                continue;
            }
            '}' if shift != Shift::None => {
                shift = Shift::None;
                continue;
            }
            '\\' => characters.next().unwrap_or('\\'),
            c => c,
        };
        match out.last_mut() {
            Some(last) if last.italic == italic && last.shift == shift => last.text.push(c),
            _ => out.push(Span { text: c.into(), italic, shift }),
        }
    }
    out
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn italics_and_shifts_in_both_languages() {
        let text = "*c*_{F} ∂*u*, m^{3}/s";
        assert_eq!(html(text), "<i>c</i><sub>F</sub> ∂<i>u</i>, m<sup>3</sup>/s");
        assert_eq!(
            svg("10^{−3} m"),
            "10<tspan dy=\"-5\" font-size=\"9\">−3</tspan><tspan dy=\"5\"> m</tspan>"
        );
        assert_eq!(plain(text), "cF ∂u, m3/s");
    }

    #[test]
    fn users_text_comes_out_as_written() {
        for text in ["a*b*c", "x_{1}", "\\", "2^{n} }", "<script>\"&'", "snake_case", ""] {
            assert_eq!(plain(&literal(text)), text);
            assert_eq!(html(&literal(text)), escape(text));
        }
        assert_eq!(escape("<a href='\"&\u{0}"), "&lt;a href=&#39;&quot;&amp;\u{fffd}");
    }

    #[test]
    fn unbalanced_markup_loses_no_text() {
        assert_eq!(plain("a*b_{c"), "abc");
        assert_eq!(plain("a_b}"), "a_b}");
    }
}
