//! A slider over time with a button that plays it, for figures that a script redraws.
//!
//! The page is complete without it: the controls are hidden until the script runs.

use serde_json::Value;

use super::super::markup::escape;

const SLIDER: &str = "<button type=\"button\">Play</button><input type=\"range\" min=\"0\" step=\"1\" \
    aria-label=\"Time\"><output></output>";

/// The controls: the slider, and a choice among `views` (the name of a figure and what it is called) where
/// there are several.
pub(in crate::report) fn controls(views: &[(&str, &str)]) -> String {
    let choice = |(k, (name, label)): (usize, &(&str, &str))| {
        let checked = if k == 0 { " checked=\"\"" } else { "" };
        format!(
            "<label><input type=\"radio\" name=\"view\" value=\"{}\"{checked}>{}</label>",
            escape(name),
            escape(label)
        )
    };
    let choices: String = views.iter().enumerate().map(choice).collect();
    let choices = match views {
        [] => String::new(),
        _ => format!("<fieldset aria-label=\"Quantity\">{choices}</fieldset>"),
    };
    format!("<div class=\"player\" hidden>{choices}{SLIDER}</div>")
}

/// The frames as JSON, with their times `t` and the one to `start` with, and the script that shows them:
/// `painter` calls `player(frames, show)`, which calls `show(k)` for frame k.
pub(in crate::report) fn script(frames: &Value, painter: &str) -> String {
    // A text in the frames must not end the element.
    let frames = frames.to_string().replace('<', "\\u003c");
    format!(
        "<script type=\"application/json\" id=\"frames\">{frames}</script>\n<script>\n{}{painter}</script>",
        include_str!("player.js"),
    )
}

/// At most `most` of the numbers below `count`, evenly spread, with the first and the last.
pub(in crate::report) fn spread(count: usize, most: usize) -> Vec<usize> {
    let kept = count.min(most);
    let last = kept.saturating_sub(1).max(1);
    (0..kept).map(|k| (k * (count - 1) + last / 2) / last).collect()
}

/// Five significant digits; what does not exist is 0.
pub(in crate::report) fn rounded(value: f64) -> f64 {
    if !value.is_finite() {
        return 0.0;
    }
    format!("{value:.4e}").parse().expect("a printed number can be read")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn samples_keep_both_ends() {
        assert_eq!(spread(5, 9), [0, 1, 2, 3, 4]);
        let some = spread(201, 81);
        assert_eq!((some.len(), some[0], some[80]), (81, 0, 200));
        assert_eq!(spread(1, 81), [0]);
        assert!(spread(0, 81).is_empty());
    }

    #[test]
    fn numbers_are_short() {
        assert_eq!(rounded(0.900_812_34), 0.900_81);
        assert_eq!(rounded(f64::NAN), 0.0);
    }

    #[test]
    fn a_text_cannot_end_the_script() {
        let script = script(&serde_json::json!({ "name": "</script>" }), "");
        assert_eq!(script.matches("</script>").count(), 2);
    }
}
