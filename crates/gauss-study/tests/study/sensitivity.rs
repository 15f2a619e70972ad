//! Sobol' indices of functions whose indices are known.

use std::f64::consts::PI;

use crate::common::Outcome;
use gauss_study::sensitivity::{Index, sobol_indices};
use gauss_study::{Declaration, Plan, uniform};

const POINTS: u64 = 4096;

/// Ishigami and Homma (1990) with a = 7, b = 0.1: sin x₁ + a sin² x₂ + b x₃⁴ sin x₁, all from −π to π.
fn ishigami([x, y, z]: [f64; 3]) -> f64 {
    x.sin() + 7.0 * y.sin().powi(2) + 0.1 * z.powi(4) * x.sin()
}

/// Its indices in closed form: first order and total.
fn known() -> [[f64; 2]; 3] {
    let (a, b, p4, p8) = (7.0_f64, 0.1_f64, PI.powi(4), PI.powi(8));
    let first = 0.5 * (1.0 + b * p4 / 5.0).powi(2);
    let second = a * a / 8.0;
    let mixed = b * b * p8 * (1.0 / 18.0 - 1.0 / 50.0);
    let all = first + second + mixed;
    [[first / all, (first + mixed) / all], [second / all, second / all], [0.0, mixed / all]]
}

fn found(seed: u64) -> Result<Vec<Index>, Box<dyn std::error::Error>> {
    let folder = tempfile::tempdir()?;
    let mut declaration = Declaration::new("ishigami", seed, 5 * POINTS).plan(Plan::Saltelli);
    let x = ["x1", "x2", "x3"].map(|name| declaration.parameter(name, "", uniform(-PI, PI)));
    let y = declaration.number("y", "");
    let study = declaration.study(move |sample, row| {
        row.set(y, ishigami(x.map(|x| sample[x])));
        Ok::<_, String>(())
    })?;
    study.run(folder.path(), |_| ())?;
    Ok(sobol_indices(&study.results(folder.path())?.numbers("y")?, 3).ok_or("it varies")?)
}

#[test]
fn indices_of_the_ishigami_function_are_those_in_closed_form() -> Outcome {
    for seed in 1..=4 {
        for (index, [first, total]) in found(seed)?.into_iter().zip(known()) {
            // Four deviations of independent points; those of a sequence are closer.
            let off = [index.first - first, index.total - total];
            for (off, error) in off.into_iter().zip(index.errors) {
                assert!(error < 0.05, "an error that says something: {index:?}");
                assert!(off.abs() < 4.0 * error + f64::EPSILON, "seed {seed}: {off} of {index:?}");
            }
        }
    }
    Ok(())
}

#[test]
fn results_that_are_missing_or_do_not_vary_are_told_of() {
    assert_eq!(sobol_indices(&[Some(1.0); 40], 2), None);
    // Equal but for rounding.
    let nearly: Vec<_> = (0..40).map(|k| Some(0.1 + f64::from(k % 2) * 1.4e-17)).collect();
    assert_eq!(sobol_indices(&nearly, 2), None);
    assert_eq!(sobol_indices(&[Some(1.0), Some(2.0), Some(3.0), None], 2), None);
    assert_eq!(sobol_indices(&[], 2), None);
    // x + 0 y from groups A, with x, with y, B; the third group is left out.
    let groups = [[1.0, 3.0, 1.0, 3.0], [4.0, 2.0, 4.0, 2.0]].as_flattened().iter().copied().map(Some);
    let values: Vec<_> = groups.chain([Some(1.0), None, Some(5.0), Some(9.0)]).collect();
    let indices = sobol_indices(&values, 2).expect("two groups are whole");
    assert!(indices[0].total > 0.9 && indices[1].total == 0.0 && indices[1].first == 0.0, "{indices:?}");
}
