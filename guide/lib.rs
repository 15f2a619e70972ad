//! The guide: `mdbook build guide` makes pages of it. Its blocks of code are tests of this crate, all compiled as one
//! program: `cargo test -p gauss-guide`. A block that needs options of its own would be compiled alone.

macro_rules! chapters {
    ($($chapter:ident: $page:literal,)*) => {$(
        #[cfg(doctest)]
        #[doc = include_str!($page)]
        pub struct $chapter;
    )*};
}

chapters! {
    Readme: "../README.md",
    FirstBody: "src/first_body.md",
    Frames: "src/frames.md",
    Charts: "src/charts.md",
    OwnCoordinates: "src/own_coordinates.md",
    Constraints: "src/constraints.md",
    Loads: "src/loads.md",
    Mass: "src/mass.md",
    States: "src/states.md",
    Reactions: "src/reactions.md",
    Flexible: "src/flexible.md",
    Touching: "src/touching.md",
    Inputs: "src/inputs.md",
    Integrators: "src/integrators.md",
    HardCases: "src/hard_cases.md",
    Derivatives: "src/derivatives.md",
    Sensitivities: "src/sensitivities.md",
    Many: "src/many.md",
    Studies: "src/studies.md",
    Embedded: "src/embedded.md",
    Robots: "src/robots.md",
    RobotsTouching: "src/robots_touching.md",
    RunTime: "src/run_time.md",
    Fmu: "src/fmu.md",
    Mujoco: "src/mujoco.md",
    Equations: "src/equations.md",
    Seeing: "src/seeing.md",
    Results: "src/results.md",
    Python: "src/python.md",
    Tasks: "src/tasks.md",
    FieldEstimation: "src/field_estimation.md",
    FromSympy: "src/from_sympy.md",
    FromPinocchioMujoco: "src/from_pinocchio_mujoco.md",
    FromMss: "src/from_mss.md",
}
