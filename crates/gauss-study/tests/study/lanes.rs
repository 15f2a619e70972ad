//! Runs that share vectors: the rows of single ones.

use crate::common::{Outcome, contents};
use gauss_batch::{Batch, Packs, States};
use gauss_runtime::prelude::*;
use gauss_study::{Declaration, normal, uniform};

/// A stone that is thrown, with drag.
#[derive(GaussDynamics)]
#[gauss(
    coordinates(x, y),
    particle(mass = m, position = [x, y, 0]),
    damping = 0.5 * d * (rate(x) * rate(x) + rate(y) * rate(y)),
)]
struct Stone<T> {
    m: T,
    d: T,
    #[gauss(gravity)]
    g: Vector3<T>,
}

fn stone<T: Real>(m: T, d: T) -> Result<StoneKernel<T>, ParameterError> {
    let number = T::from_f64;
    Stone { m, d, g: Vector3::new(number(0.0), number(-9.81), number(0.0)) }.kernel()
}

type Pack = Lanes<f64, 4>;

#[test]
fn rows_of_lanes_are_those_of_single_runs() -> Outcome {
    let declared = || {
        let mut study = Declaration::new("stones", 3, 300).runs_per_part(50);
        let mass = study.parameter("mass", "kg", uniform(0.2, 0.4));
        let drag = study.parameter("drag", "kg/s", uniform(0.05, 0.1));
        let angle = study.parameter("angle", "rad", normal(0.7, 0.05));
        let range = study.number("range", "m");
        (study, mass, drag, angle, range)
    };
    let start = |angle: f64| (SVector::from([0.0, 0.0]), SVector::from([20.0 * angle.cos(), 20.0 * angle.sin()]));

    let (study, mass, drag, angle, range) = declared();
    let single = study.study(move |draw, row| {
        let (kernel, (q, z)) = (stone(draw[mass], draw[drag])?, start(draw[angle]));
        let end = Simulation::new(&kernel).fixed_step(0.05).run_to_end(q, z, 0.0..1.5)?;
        row.set(range, end.q[0]);
        Ok::<_, Box<dyn std::error::Error>>(())
    })?;

    let (study, mass, drag, angle, range) = declared();
    let lanes = study.study_in_blocks(16, move |draws, rows| {
        let column = |of| Packs::<Pack>::from_fn(draws.len(), |i| draws[i][of]);
        let (masses, drags) = (column(mass), column(drag));
        let pairs = masses.blocks().iter().zip(drags.blocks());
        let kernels: Vec<_> = pairs.map(|(m, d)| stone(*m, *d)).collect::<Result<_, _>>()?;
        let mut states = States::<StoneKernel<Pack>>::from_fn(draws.len(), |i| start(draws[i][angle]));
        Batch::each(&kernels).advance(&RungeKutta(DormandPrince8), 0.05, 0.0..1.5, &mut states)?;
        states.iter().zip(rows).for_each(|((q, _), row)| row.set(range, q[0]));
        Ok::<_, Box<dyn std::error::Error>>(())
    })?;

    let (one, many) = (tempfile::tempdir()?, tempfile::tempdir()?);
    single.run(one.path(), |_| ())?;
    assert_eq!(lanes.run(many.path(), |_| ())?.failed, 0);
    assert_eq!(contents(one.path())?, contents(many.path())?);
    Ok(())
}
