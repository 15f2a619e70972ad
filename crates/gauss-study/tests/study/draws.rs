//! A run is a function of the seed and its number.

use std::collections::HashSet;

use crate::common::Outcome;
use gauss_study::{Declaration, Plan, Sampler, fixed, grid, list, log_normal, normal, truncated_normal, uniform};

const RUNS: u64 = 1024;

fn sampler(seed: u64, plan: Plan, names: &[&str]) -> Result<Sampler, gauss_study::DeclarationError> {
    let mut declaration = Declaration::new("draws", seed, RUNS).plan(plan);
    for name in names {
        declaration.parameter(name, "", uniform(0.0, 1.0));
    }
    declaration.sampler()
}

/// Numbers of one parameter.
fn column(sampler: &Sampler, place: usize) -> Vec<f64> {
    (0..RUNS).map(|run| sampler.sample(run).values()[place]).collect()
}

const PLANS: [Plan; 3] = [Plan::Random, Plan::LatinHypercube, Plan::Sobol];

#[test]
fn neighbouring_seeds_share_no_numbers() -> Outcome {
    // 53-bit numbers: of 2 × 10⁵ of them two are equal with a chance of (2 × 10⁵)² / 2⁵³ = 4e-6.
    let mut seen = HashSet::new();
    for seed in (0..50).chain([u64::MAX - 1, u64::MAX]) {
        let sampler = sampler(seed, Plan::Random, &["a", "b"])?;
        for place in [0, 1] {
            for number in column(&sampler, place) {
                assert!(seen.insert(number.to_bits()), "seed {seed}: {number} again");
            }
        }
    }
    Ok(())
}

#[test]
fn a_run_does_not_depend_on_what_was_run_before() -> Outcome {
    for plan in PLANS {
        let [here, there] = [sampler(3, plan, &["a", "b", "c"])?, sampler(3, plan, &["a", "b", "c"])?];
        let forward: Vec<_> = (0..RUNS).map(|run| here.sample(run)).collect();
        let backward: Vec<_> = (0..RUNS).rev().map(|run| there.sample(run)).collect();
        assert!(forward.iter().eq(backward.iter().rev()), "{plan:?}");
    }
    Ok(())
}

#[test]
fn another_parameter_changes_no_number_of_the_others() -> Outcome {
    for plan in PLANS {
        let (few, more) = (sampler(3, plan, &["a", "b"])?, sampler(3, plan, &["a", "b", "c"])?);
        assert!([0, 1].into_iter().all(|place| column(&few, place) == column(&more, place)), "{plan:?}");
    }
    for plan in [Plan::Random, Plan::LatinHypercube] {
        let (few, more) = (sampler(3, plan, &["a", "b"])?, sampler(3, plan, &["c", "b", "a"])?);
        assert!(column(&few, 0) == column(&more, 2) && column(&few, 1) == column(&more, 1), "{plan:?}");
    }
    Ok(())
}

#[test]
fn parameters_are_independent_and_uniform() -> Outcome {
    for plan in PLANS {
        let sampler = sampler(9, plan, &["a", "b", "c"])?;
        let columns = [0, 1, 2].map(|place| column(&sampler, place));
        for (i, j) in [(0, 1), (0, 2), (1, 2)] {
            // Correlations of independent numbers deviate by 1/√1024; four deviations.
            let product = columns[i].iter().zip(&columns[j]).map(|(a, b)| 12.0 * (a - 0.5) * (b - 0.5)).sum::<f64>();
            assert!((product / RUNS as f64).abs() < 4.0 / (RUNS as f64).sqrt(), "{plan:?} {i} {j}: {product}");
        }
        for column in columns {
            let mut parts = [0.0; 16];
            column.iter().for_each(|number| parts[(16.0 * number) as usize] += 1.0);
            // χ² of 15 degrees of freedom, above 45 with 1e-4.
            let chi: f64 = parts.iter().map(|count: &f64| (count - 64.0).powi(2) / 64.0).sum();
            assert!(chi < if plan == Plan::Random { 45.0 } else { 1e-9 }, "{plan:?}: {chi}");
        }
    }
    Ok(())
}

#[test]
fn a_latin_hypercube_has_a_number_in_every_stratum() -> Outcome {
    // No power of two, and strata whose ends are rounded.
    for runs in [1_u64, 3, 1000] {
        let mut declaration = Declaration::new("latin", 4, runs).plan(Plan::LatinHypercube);
        declaration.parameter("a", "", uniform(0.0, 1.0));
        let sampler = declaration.sampler()?;
        let strata: HashSet<_> = (0..runs).map(|run| (sampler.sample(run).values()[0] * runs as f64) as u64).collect();
        assert_eq!(strata.len() as u64, runs);
    }
    Ok(())
}

#[test]
fn sobol_sequences_fill_the_plane_after_their_shift() -> Outcome {
    // The first two dimensions are a (0, 10, 2)-net: each of 2¹⁰ boxes of 2ᵏ by 2¹⁰⁻ᵏ parts holds one of 2¹⁰ points.
    let sampler = sampler(7, Plan::Sobol, &["a", "b"])?;
    for k in 0..=10 {
        let parts = [f64::from(1 << k), f64::from(1 << (10 - k))];
        let boxed = |run| [0, 1].map(|place| (sampler.sample(run).values()[place] * parts[place]) as u64);
        assert_eq!((0..RUNS).map(boxed).collect::<HashSet<_>>().len() as u64, RUNS, "2^{k}");
    }
    Ok(())
}

#[test]
fn saltelli_groups_change_one_parameter_at_a_time() -> Outcome {
    let mut declaration = Declaration::new("saltelli", 5, 5 * 8).plan(Plan::Saltelli);
    for name in ["a", "b", "c"] {
        declaration.parameter(name, "", normal(0.0, 1.0));
        declaration.parameter(&format!("{name}_fixed"), "", fixed(2.0));
    }
    let sampler = declaration.sampler()?;
    for group in 0..8 {
        let runs: Vec<_> = (5 * group..5 * group + 5).map(|run| sampler.sample(run).values().to_vec()).collect();
        for place in 0..3 {
            let (a, b) = (runs[0][2 * place], runs[4][2 * place]);
            assert_ne!(a, b);
            for mixed in 1..=3 {
                assert_eq!(runs[mixed][2 * place], if mixed == place + 1 { b } else { a });
            }
        }
        assert!(runs.iter().all(|run| run[1] == 2.0));
    }
    Ok(())
}

#[test]
fn grids_go_through_all_combinations() -> Outcome {
    let mut declaration = Declaration::new("sweep", 5, 12);
    declaration.parameter("x", "", grid(0.0, 2.0, 3));
    declaration.parameter("noise", "", normal(0.0, 1.0));
    declaration.parameter("y", "", grid(1.0, 2.0, 2));
    let sampler = declaration.sampler()?;
    let all: Vec<_> = (0..12).map(|run| sampler.sample(run).values().to_vec()).collect();
    let cells: Vec<_> = all[..6].iter().map(|values| [values[0], values[2]]).collect();
    assert_eq!(cells, [[0.0, 1.0], [1.0, 1.0], [2.0, 1.0], [0.0, 2.0], [1.0, 2.0], [2.0, 2.0]]);
    for (first, again) in all[..6].iter().zip(&all[6..]) {
        assert!(first[0] == again[0] && first[2] == again[2] && first[1] != again[1]);
    }
    Ok(())
}

#[test]
fn streams_within_runs_are_their_own() -> Outcome {
    let sampler = sampler(1, Plan::Random, &["a"])?;
    let number = |run: u64, name: &str| sampler.sample(run).stream(name).uniform();
    assert_eq!(number(3, "wind"), number(3, "wind"));
    assert_eq!(number(3, "wind"), gauss_study::Stream::by(1, "wind", 3).uniform());
    let all = [number(3, "wind"), number(4, "wind"), number(3, "a"), sampler.sample(3).values()[0]];
    assert_eq!(all.map(f64::to_bits).into_iter().collect::<HashSet<_>>().len(), 4);
    Ok(())
}

#[test]
fn all_mistakes_of_a_declaration_come_at_once() {
    let mut declaration = Declaration::new("wrong", 1, 0).plan(Plan::Saltelli).runs_per_part(0);
    declaration.parameter("a", "", uniform(1.0, 0.0));
    declaration.parameter("a", "", truncated_normal(0.0, 1.0, 60.0, 61.0));
    declaration.parameter("run", "", log_normal(-1.0, 1.0));
    declaration.parameter("2b", "", list([]));
    declaration.parameter("sweep", "", grid(0.0, 1.0, 3));
    declaration.number("x y", "m");
    let error = declaration.sampler().expect_err("nothing of it is right");
    let words = [
        "runs = 0",
        "runs_per_part = 0",
        "`a`: two columns",
        "`run`: every file",
        "`2b`: a name",
        "`x y`: a name",
        "parameter `a`, Uniform",
        "parameter `a`, TruncatedNormal",
        "parameter `run`, LogNormal",
        "parameter `2b`, List",
        "beside a grid",
    ];
    for word in words {
        assert!(error.mistakes().iter().any(|mistake| mistake.contains(word)), "{word}: {error}");
    }
    assert_eq!(error.mistakes().len(), words.len(), "{error}");
}

#[test]
fn plans_that_have_too_few_dimensions_are_refused() {
    for (plan, most) in [(Plan::Sobol, 100), (Plan::Saltelli, 50)] {
        let mut declaration = Declaration::new("many", 1, 52 * 51).plan(plan);
        (0..most).for_each(|k| _ = declaration.parameter(&format!("p{k}"), "", uniform(0.0, 1.0)));
        let refused = declaration.sampler().err().map(|error| error.to_string());
        assert!(refused.is_none(), "{plan:?}: {refused:?}");
        declaration.parameter("more", "", uniform(0.0, 1.0));
        assert!(declaration.sampler().is_err(), "{plan:?}");
    }
}
