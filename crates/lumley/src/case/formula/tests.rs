use super::{Formula, Variables};

fn value(text: &str) -> f64 {
    let formula = Formula::read(text, Variables::PlaceAndTime);
    formula.unwrap_or_else(|e| panic!("{text}: {e}")).value([2.0, 3.0], 0.5)
}

#[test]
fn operations_have_their_order() {
    for (text, expected) in [
        ("1 + 2*3", 7.0),
        ("8 - 4 - 2", 2.0),
        ("8/4/2", 1.0),
        ("-2^2", -4.0),
        ("2^3^2", 512.0),
        ("2^-1", 0.5),
        ("1 - y^2", -8.0),
        ("(1 + 2)*3", 9.0),
        ("--x", 2.0),
        ("+x", 2.0),
        ("2*-x", -4.0),
        ("1e-3*x", 2e-3),
        ("1.5E2", 150.0),
        (".5", 0.5),
        ("x < y", 1.0),
        ("x + 1 >= y + 1", 0.0),
    ] {
        assert_eq!(value(text), expected, "{text}");
    }
}

#[test]
fn functions_are_those_of_mathematics() {
    for (text, expected) in [
        ("sin(pi*x)", (std::f64::consts::PI * 2.0).sin()),
        ("exp(-t)", (-0.5_f64).exp()),
        ("ln(e)", 1.0),
        ("atan2(y, x)", 3.0_f64.atan2(2.0)),
        ("hypot(x, y)", 13.0_f64.sqrt()),
        ("min(x, y) + 10*max(x, y)", 32.0),
        ("step(x - 2) + step(x - 2.1)", 1.0),
        ("sign(-x) + sign(0)", -1.0),
        ("if(t < 1, x, y)", 2.0),
        ("if(t > 1, 1/0, y)", 3.0),
        ("floor(2.5) + log10(1000)", 5.0),
        ("sqrt(abs(-9))", 3.0),
    ] {
        assert!((value(text) - expected).abs() < 1e-15 * expected.abs().max(1.0), "{text}");
    }
    assert!(value("sqrt(-1)").is_nan() && value("1/0").is_infinite());
    assert!(value("max(1, 0/0)").is_nan() && value("max(0/0, 1)").is_nan(), "no NaN is lost");
    assert!(value("min(1, 0/0)").is_nan() && value("step(0/0)").is_nan(), "no NaN is lost");
}

#[test]
fn wrong_formulas_are_refused_with_the_place() {
    for (text, column, expected) in [
        ("", 1, "a number"),
        ("2 x", 3, "an operation"),
        ("x +", 4, "a number"),
        ("(x", 3, "\")\""),
        ("x)", 2, "an operation"),
        ("sin x", 5, "\"(\""),
        ("min(x)", 6, "\",\""),
        ("sin(x, y)", 6, "\")\""),
        ("1.2.3", 1, "a number such as"),
        ("1e999", 1, "a number such as"),
        ("z", 1, "x, y, t"),
        ("sqr(x)", 1, "sqrt"),
        ("log(x)", 1, "log10"),
        ("x < y < t", 7, "an operation"),
        ("é + x", 1, "x, y, t"),
        ("x # y", 3, "an operation"),
    ] {
        let error = Formula::read(text, Variables::PlaceAndTime).expect_err(text);
        assert_eq!(error.column, column, "{text}: {error}");
        assert!(error.to_string().contains(expected), "{text}: {error}");
    }
    assert!(Formula::read("t", Variables::Place).is_err());
    assert!(Formula::read("x", Variables::Time).is_err());
}

/// Neither the reader's stack nor the evaluation's can be made to overflow.
#[test]
fn deep_formulas_are_refused() {
    for text in [
        "(".repeat(2000) + "x" + &")".repeat(2000),
        "-".repeat(4000) + "x",
        "x^".repeat(2000) + "x",
        "x + (".repeat(40) + "x" + &")".repeat(40),
        "x".repeat(5000),
    ] {
        let error = Formula::read(&text, Variables::PlaceAndTime).expect_err("too deep");
        assert!(error.to_string().contains("at most") || error.to_string().contains("wait"));
    }
    assert_eq!(value(&("1 + ".repeat(1000) + "x")), 1002.0);
}

#[test]
fn formulas_know_whether_they_need_the_time() {
    let formula = |text| Formula::read(text, Variables::PlaceAndTime).expect("right");
    assert!(formula("sin(2*t)").uses_time() && !formula("x*tan(y)").uses_time());
    assert_eq!(formula("1 + x"), formula("1+x"));
    assert_ne!(formula("1 + x"), formula("1 - x"));
}
