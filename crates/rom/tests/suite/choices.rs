//! The tables of a case file.

use lumley_rom::{
    ClosureKind, EddyViscosity, Integrator, ModelChoice, Multiplier, Penalty, ProjectionKind,
    Rosenbrock,
};
use serde::{Deserialize, Serialize};

fn model(table: &str) -> Result<ModelChoice, toml::de::Error> {
    toml::from_str(table)
}

#[derive(Debug, Serialize, Deserialize)]
struct Rom {
    integrator: Integrator,
}

#[test]
fn every_projection_has_its_name_and_defaults() {
    let choices = [
        ("printed", ProjectionKind::Printed {}),
        ("corrected", ProjectionKind::Corrected {}),
        ("multiplier", ProjectionKind::Multiplier(Multiplier { beta: 50.0 })),
        ("penalty", ProjectionKind::Penalty(Penalty { sigma: 100.0 })),
        ("mapped", ProjectionKind::Mapped {}),
    ];
    for (name, projection) in choices {
        let read = model(&format!("projection = '{name}'")).expect(name);
        assert_eq!(read, ModelChoice { projection, closure: ClosureKind::None {} });
        assert_eq!(projection.name(), name);
    }
}

#[test]
fn closures_are_names_or_tables() {
    let eddy = |rate| ClosureKind::EddyViscosity(EddyViscosity { rate });
    for (written, closure) in [
        ("'none'", ClosureKind::None {}),
        ("'eddy-viscosity'", eddy(0.001)),
        ("{ kind = 'none' }", ClosureKind::None {}),
        ("{ kind = 'eddy-viscosity' }", eddy(0.001)),
        ("{ rate = 0.01, kind = 'eddy-viscosity' }", eddy(0.01)),
    ] {
        let table = format!("projection = 'penalty'\nsigma = 3.0\nclosure = {written}");
        let read = model(&table).expect(written);
        assert_eq!(read.projection, ProjectionKind::Penalty(Penalty { sigma: 3.0 }));
        assert_eq!(read.closure, closure);
    }
}

#[test]
fn integrators_are_names_or_tables() {
    for (written, integrator) in [
        ("'rk4'", Integrator::Rk4 {}),
        ("'rosenbrock'", Integrator::Rosenbrock(Rosenbrock { tolerance: 1e-8 })),
        (
            "{ kind = 'rosenbrock', tolerance = 1e-5 }",
            Integrator::Rosenbrock(Rosenbrock { tolerance: 1e-5 }),
        ),
    ] {
        let read: Rom = toml::from_str(&format!("integrator = {written}")).expect(written);
        assert_eq!(read.integrator, integrator);
    }
}

#[test]
fn unknown_keys_and_names_are_refused_with_what_is_known() {
    for (table, expected) in [
        ("projection = 'galerkin'", "unknown variant `galerkin`, expected one of `printed`"),
        ("sigma = 3.0", "missing field `projection`"),
        ("projection = 'penalty'\nbeta = 3.0", "unknown field `beta`, expected `sigma`"),
        ("projection = 'mapped'\nsigma = 3.0", "unknown field `sigma`"),
        ("projection = 'printed'\nclosur = 'none'", "unknown field `closur`"),
        ("projection = 'penalty'\nsigma = 'big'", "expected f64"),
        ("projection = 'mapped'\nclosure = 'smagorinsky'", "unknown variant `smagorinsky`"),
        ("projection = 'mapped'\nclosure = { kind = 'none', rate = 1.0 }", "unknown field `rate`"),
        (
            "projection = 'mapped'\nclosure = { kind = 'eddy-viscosity', c = 1.0 }",
            "unknown field `c`",
        ),
        ("projection = 'mapped'\nclosure = 3", "a name or a table with the key `kind`"),
    ] {
        let error = model(table).expect_err(table).to_string();
        assert!(error.contains(expected), "{table}: {error}");
    }
    let error = toml::from_str::<Rom>("integrator = { kind = 'rk4', tolerance = 1.0 }");
    let error = error.expect_err("RK4 has no tolerance").to_string();
    assert!(error.contains("unknown field `tolerance`"), "{error}");
}

/// What is written into a resolved case is what was meant.
#[test]
fn choices_survive_writing_and_reading() {
    for table in [
        "projection = 'multiplier'\nclosure = 'eddy-viscosity'",
        "projection = 'mapped'",
        "projection = 'penalty'\nsigma = 12.5",
    ] {
        let read = model(table).expect(table);
        let written = toml::to_string(&read).expect("a table");
        assert_eq!(model(&written).expect(&written), read, "{written}");
    }
    let rom = Rom { integrator: Integrator::Rosenbrock(Rosenbrock::default()) };
    let written = toml::to_string(&rom).expect("a table");
    let read: Rom = toml::from_str(&written).expect(&written);
    assert_eq!(read.integrator, rom.integrator);
}
