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
            [
                "cylinder: no-slip, of the body cylinder",
                "body            cylinder: prescribed",
                "cylinder.y (prescribed)",
                "Re = 185.000",
            ],
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

/// The bodies with their coordinates, and how near to its limit the explicit coupling is: the fluid that the cylinder
/// displaces has 0.785 kg/m.
#[test]
fn check_tells_of_bodies_and_of_their_added_mass() {
    let desk = Desk::new();
    let text = desk.lumley(&["cases", "oscillating-cylinder"]).good().stdout;
    let start = text.find("boundary = \"cylinder\"").expect("a body");
    let end = text.find("[time]").expect("a time");
    let body =
        "boundary = \"cylinder\"\nmass = 2.5\njoint = { kind = \"prismatic\", along = [0, 1] }\n";
    desk.write("case.toml", format!("{}{body}{}", &text[..start], &text[end..]).as_bytes());
    let check = |settings: &[&str]| {
        let set = settings.iter().flat_map(|setting| ["--set", setting]);
        let words: Vec<&str> = ["check", "case.toml", "--quick"].into_iter().chain(set).collect();
        desk.lumley(&words).good().stdout
    };
    let told = check(&["motion.gravity=[0, -9.81]"]);
    for words in [
        "body            cylinder: prismatic, 2.5 kg/m\n",
        "coordinates     cylinder.distance\n",
        "gravity         (0, -9.81) m/s²",
        "coupling        monolithic\n",
    ] {
        assert!(told.contains(words), "no {words:?} in:\n{told}");
    }
    for (settings, share, warning) in [
        (["bodies.cylinder.mass=0.8", "time.scheme=bdf2"], "0.982", "will become unstable"),
        (["bodies.cylinder.mass=10", "time.scheme=bdf2"], "0.079", ""),
        (["bodies.cylinder.mass=1", "time.scheme=implicit-euler"], "0.785", "may become unstable"),
    ] {
        let told = check(&[settings[0], settings[1], "motion.coupling=explicit"]);
        let share = format!("explicit, the added mass is about {share} of the bodies' own");
        assert!(told.contains(&share) && told.contains(warning), "{told}");
        assert_eq!(told.contains("unstable"), !warning.is_empty(), "{told}");
    }
    // What only the mesh knows is known before the run, too.
    let wide = "motion.rigid_zone=20";
    let answer = desk.lumley(&["check", "case.toml", "--quick", "--set", wide]);
    answer.refused(2, &["rigid zone of 20 m", "\"cylinder\"", "the largest that fits"]);
}
