//! The claims of the example `lander_legs`: the speed at which it tips over, and that runs are functions of their
//! numbers.

use std::error::Error;

use crate::lander::{G, LONGEST, Lander, Lever, Outcome, Parameters, STEP, above_ground, touch_down};
use gauss_runtime::prelude::*;
use gauss_study::Declaration;

/// Feet that stick, struts that hold.
fn stiff() -> Lander {
    Lander { crush: 1e7, ..Lander::small(5.0, 0.0) }
}

/// Flat, so high that its feet touch in the middle of the first step.
fn outcome(lander: &Lander, speed: f64, fall: f64, h: f64) -> Result<Outcome, Box<dyn Error>> {
    let velocity = Vector3::new(speed, 0.0, -fall);
    let ((mut pose, struts), z) = above_ground(lander, UnitQuaternion::identity(), velocity, Vector3::zeros());
    pose.translation.z += 0.5 * h * fall;
    // On the edge it takes its time.
    Ok(touch_down(&lander.kernel()?, ((pose, struts), z), (h, 60.0), |_| ())?.outcome)
}

#[test]
fn it_tips_over_above_the_speed_that_energy_allows() -> Result<(), Box<dyn Error>> {
    let lander = stiff();
    let Lever { mass, inertia, height } = lander.lever();
    for (fall, h) in [(0.5, 4.0 * STEP), (0.5, STEP), (1.5, STEP)] {
        let at_touch = fall + 0.5 * h * G;
        let critical = lander.tips_above(at_touch);
        let turn = mass * (height * critical - lander.a * at_touch) / inertia;
        // In the step of the touch forces are those at the mean of the speeds before it and after it. What turns the
        // velocity with the lander is so off by up to half of the turn in the second half of that step.
        let margin = 0.5 * critical * turn * h;
        assert!(margin < 2e-3 * critical, "a criterion that says something: {margin} of {critical} m/s");
        assert_ne!(outcome(&lander, critical - margin, fall, h)?, Outcome::Tips, "{fall} m/s down, steps of {h} s");
        assert_eq!(outcome(&lander, critical + margin, fall, h)?, Outcome::Tips, "{fall} m/s down, steps of {h} s");
    }
    Ok(())
}

#[test]
fn crushed_struts_take_the_energy_of_the_fall() -> Result<(), Box<dyn Error>> {
    // Straight down at 1.5 m/s on all feet: what the hull has and its weight does more, the struts take by their force.
    let lander = Lander::small(0.5, 0.0);
    let start = above_ground(&lander, UnitQuaternion::identity(), Vector3::new(0.0, 0.0, -1.5), Vector3::zeros());
    let landing = touch_down(&lander.kernel()?, start, (STEP, LONGEST), |_| ())?;
    let way = 0.5 * lander.m * 1.5 * 1.5 / (4.0 * lander.crush - lander.m * G);
    // Known to the way of a step.
    assert!((landing.crushed - way).abs() < 1.5 * STEP, "{} m for {way} m", landing.crushed);
    assert!(landing.outcome == Outcome::Stands && landing.slid == 0.0);
    Ok(())
}

#[test]
fn on_a_slope_it_stands_below_the_angle_of_friction_and_slides_above() -> Result<(), Box<dyn Error>> {
    for (mu, outcome) in [(0.28, Outcome::Stands), (0.26, Outcome::Slides)] {
        // 15°, whose tangent is 0.268.
        let lander = Lander::small(mu, 15.0_f64.to_radians());
        let start = above_ground(&lander, UnitQuaternion::identity(), Vector3::new(0.0, 0.0, -0.1), Vector3::zeros());
        assert_eq!(touch_down(&lander.kernel()?, start, (STEP, LONGEST), |_| ())?.outcome, outcome, "{mu}");
    }
    Ok(())
}

#[test]
fn a_run_is_a_function_of_its_seed_and_number() -> Result<(), Box<dyn Error>> {
    let run = |seed: u64, i: u64| {
        let mut study = Declaration::new("touchdowns", seed, 6);
        let parameters = Parameters::declare_all(&mut study);
        let approach = parameters.approach(&study.sampler()?.sample(i));
        let landing = approach.touch_down()?;
        // Laws are solved to 1e-12 of the largest rate, some m/s, nearly always, and to 1e-8 of it always; gaps are
        // rounded at the size of coordinates, some ten metres.
        assert!(landing.residual < 1e-7 && landing.lowest > -1e-13, "{} {}", landing.residual, landing.lowest);
        Ok::<_, Box<dyn Error>>([approach.lateral, approach.slope, landing.crushed, landing.slid].map(f64::to_bits))
    };
    let before: Vec<_> = (0..6).map(|i| run(1, i)).collect::<Result<_, _>>()?;
    for i in [5, 2, 0] {
        assert_eq!(run(1, i)?, before[i as usize]);
        assert_ne!(run(2, i)?, before[i as usize]);
    }
    Ok(())
}
