//! A small parser that tests use to look at what was written.

/// Elements without an end, and elements whose content is not markup, in HTML.
const VOID: [&str; 2] = ["meta", "input"];
const RAW: [&str; 2] = ["script", "style"];

/// What was found of an element's start.
#[derive(Debug)]
pub(crate) struct Element {
    pub tag: String,
    pub attributes: Vec<(String, String)>,
}

/// All elements of a text whose tags are balanced and whose attributes and entities are right.
pub(crate) fn elements(mut text: &str) -> Result<Vec<Element>, String> {
    let (mut open, mut found) = (Vec::new(), Vec::new());
    while let Some(start) = text.find('<') {
        entities(&text[..start])?;
        let end = text.find('>').ok_or("a tag without end")?;
        let tag = &text[start + 1..end];
        text = &text[end + 1..];
        if tag.starts_with("!doctype") {
            continue;
        }
        if let Some(name) = tag.strip_prefix('/') {
            let expected = open.pop();
            if expected.as_deref() != Some(name) {
                return Err(format!("</{name}> where {expected:?} was open"));
            }
            continue;
        }
        let element = element(tag.trim_end_matches('/'))?;
        if RAW.contains(&&*element.tag) {
            let close = format!("</{}>", element.tag);
            text = &text[text.find(&close).ok_or("a script or style without end")?..];
        }
        if !tag.ends_with('/') && !VOID.contains(&&*element.tag) {
            open.push(element.tag.clone());
        }
        found.push(element);
    }
    entities(text)?;
    if open.is_empty() { Ok(found) } else { Err(format!("still open: {open:?}")) }
}

fn element(tag: &str) -> Result<Element, String> {
    let (name, mut rest) = tag.split_once(' ').unwrap_or((tag, ""));
    let mut attributes = Vec::new();
    while !rest.trim().is_empty() {
        let Some((key, after)) = rest.split_once("=\"") else {
            return if rest.trim() == "hidden" {
                break;
            } else {
                Err(format!("attribute in <{tag}>"))
            };
        };
        let (value, after) = after.split_once('"').ok_or(format!("open quote in <{tag}>"))?;
        entities(value)?;
        attributes.push((key.trim().to_string(), value.to_string()));
        rest = after;
    }
    let plain = |text: &str| text.chars().all(|c| c.is_ascii_alphanumeric() || "-_:".contains(c));
    if !plain(name) || !attributes.iter().all(|(key, _)| plain(key)) {
        return Err(format!("name in <{tag}>"));
    }
    Ok(Element { tag: name.into(), attributes })
}

/// Every ampersand starts one of the entities that are written here; no control characters.
fn entities(text: &str) -> Result<(), String> {
    const KNOWN: [&str; 5] = ["amp;", "lt;", "gt;", "quot;", "#39;"];
    let known = |rest: &str| KNOWN.iter().any(|entity| rest.starts_with(entity));
    if let Some(rest) = text.split('&').skip(1).find(|rest| !known(rest)) {
        return Err(format!("&{rest}"));
    }
    match text.chars().find(|c| c.is_control() && *c != '\n' && *c != '\t') {
        Some(c) => Err(format!("control character {c:?}")),
        None => Ok(()),
    }
}

#[test]
fn the_parser_finds_what_is_wrong() {
    let found = elements("<svg a=\"1\"><g/><text x=\"2\">a &amp; b</text></svg>").expect("right");
    assert_eq!(found.len(), 3);
    assert_eq!(found[2].attributes, [("x".to_string(), "2".to_string())]);
    let wrong =
        ["<a>", "<a></b>", "<a b=c/>", "<a b=\"1/>", "a & b", "<a b=\"&\"/>", "<a\u{1}/>", "</a>"];
    for text in wrong {
        assert!(elements(text).is_err(), "{text}");
    }
}
