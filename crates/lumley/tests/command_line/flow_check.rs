//! `lumley check` of flows, and `lumley cases`.

use crate::Desk;

/// What there is to know before a run, for every flow that comes with lumley.
#[test]
fn check_tells_what_a_flow_would_cost() {
    let desk = Desk::new();
    for (name, words) in [
        ("cavity", ["1600 quadrilaterals", "17922 unknowns", "no outlet", "an iteration"]),
        ("cylinder-2d1", ["right: traction-free", "the creeping flow", "Re = 20.000", "MB"]),
        (
            "cylinder-2d2",
            ["1600 steps of 0.005 s", "201 snapshots on 441 x 83", "81 files", "auto"],
        ),
        (
            "oscillating-cylinder",
            ["cylinder: no-slip, moves", "top: slip", "Re = 185.000", "paraview"],
        ),
    ] {
        let text = desk.lumley(&["cases", name]).good().stdout;
        desk.write(&format!("{name}/case.toml"), text.as_bytes());
        let answer = desk.lumley(&["check", &format!("{name}/case.toml")]).good();
        for word in words.iter().chain(&["scaled Jacobian", "aspect ratio", "disk", "memory"]) {
            assert!(answer.stdout.contains(word), "no {word:?} in:\n{}", answer.stdout);
        }
        let quick = desk.lumley(&["check", &format!("{name}/case.toml"), "--quick"]).good();
        let unknowns = |text: &str| {
            let words: Vec<&str> = text.split_whitespace().collect();
            let at = words.iter().position(|word| *word == "unknowns,").expect("unknowns");
            words[at - 1].parse::<usize>().expect("a number")
        };
        assert!(3 * unknowns(&quick.stdout) < unknowns(&answer.stdout), "{name} is not coarser");
    }
}

#[test]
fn adaptive_steps_take_a_range_of_time() {
    let desk = Desk::new();
    let text = desk.lumley(&["cases", "cylinder-2d2"]).good().stdout;
    let adaptive = "adaptive = { tolerance = 1e-3, shortest = 1e-4, longest = 1e-2 }\nscheme";
    desk.write("case.toml", text.replacen("scheme", adaptive, 1).as_bytes());
    let answer = desk.lumley(&["check", "case.toml", "--quick"]).good();
    assert!(answer.stdout.contains("steps of 0.0001 to 0.01 s to 3 s"), "{}", answer.stdout);
}

#[test]
fn wrong_flows_are_refused_with_their_line() {
    let desk = Desk::new();
    let text = desk.lumley(&["cases", "cavity"]).good().stdout;
    let line =
        |wrong: &str| 1 + wrong[..wrong.find("[\"2 x\"").expect("there")].matches('\n').count();
    let wrong = text.replacen("[1, 0]", "[\"2 x\", 0]", 1);
    desk.write("case.toml", wrong.as_bytes());
    let place = format!("case.toml, line {}:", line(&wrong));
    desk.lumley(&["check", "case.toml"])
        .refused(2, &[&place, "an operation", "character 3", "\"x\""]);
    desk.lumley(&["run", "case.toml"]).refused(2, &[&place]);
}
