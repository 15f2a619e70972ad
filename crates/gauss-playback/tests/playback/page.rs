//! The page holds what was asked for, where the kernel says it is.

use gauss_playback::{Playback, PlaybackError, Recording, Shape};
use gauss_runtime::prelude::*;
use serde_json::Value;

/// Two rods; the lower hangs from the end of the upper one.
#[derive(GaussDynamics)]
#[gauss(
    coordinates(a, b),
    body(
        upper, rotation = rotation_y(a),
        mass = 1.0, inertia_about_center_of_mass = [0.1, 0.1, 0.01], center_of_mass = [0, 0, -0.5],
    ),
    body(
        lower, parent = upper, position = [0, 0, -1], rotation = rotation_y(b),
        mass = 1.0, inertia_about_center_of_mass = [0.1, 0.1, 0.01], center_of_mass = [0, 0, -0.5],
    ),
    gravity = 9.81,
    frames(upper, lower),
)]
struct Pendulum {}

fn data(page: &str) -> Value {
    let (_, rest) = page.split_once("<script id=\"data\" type=\"application/json\">").expect("the mark of the data");
    let (data, _) = rest.split_once("</script>").expect("the end of the data");
    serde_json::from_str(data).expect("JSON")
}

#[test]
fn poses_are_those_of_the_kernel_and_nothing_comes_from_elsewhere() -> Result<(), Box<dyn std::error::Error>> {
    let kernel = Pendulum {}.kernel()?;
    let start = SVector::<f64, 2>::new(1.0, 0.5);
    let path = Simulation::new(&kernel).adaptive(1e-9, 1e-9).run(start, SVector::zeros(), 0.0..1.0)?;
    let title = "Two rods </script><b> & more";
    let page = Playback::with_pictures(title, &path, 11)?
        .frames(&kernel)
        .shape("lower", Shape::rod([0.0; 3], [0.0, 0.0, -1.0], 0.02))
        .rod("upper", "lower", 0.02)
        .trace("lower", [0.0, 0.0, -1.0])
        .arrow("weight", 0.1, |s| (kernel.pose_of(PendulumFrame::lower, s.t, &s.q).translation.vector, -Vector3::z()))
        .energy(&kernel)
        .html()?;
    assert!(!page.contains("://"), "a page without network");
    assert_eq!(page.matches("</script>").count(), 2, "the title ends no script");

    let data = data(&page);
    assert_eq!(data["title"], title);
    let lower = &data["bodies"][1];
    assert_eq!(lower["name"], "lower");
    for n in 0..11 {
        let sample = path.at(if n == 10 { 1.0 } else { 0.1 * n as f64 })?;
        // By hand: the end of the upper rod.
        let expected = [-sample.q[0].sin(), 0.0, -sample.q[0].cos()];
        for (k, expected) in expected.into_iter().enumerate() {
            let shown = lower["poses"][n][k].as_f64().expect("a number");
            // A float of 24 bits.
            assert!((shown - expected).abs() < 1e-7, "{n} {k}: {shown} {expected}");
        }
    }
    let curves = data["panels"][0]["curves"].as_array().expect("curves");
    let sums = curves[2]["values"].as_array().expect("values");
    let start = kernel.potential_energy(0.0, &start);
    // The tolerance of the run times the energies that are exchanged.
    assert!(sums.iter().all(|sum| (sum.as_f64().expect("a number") - start).abs() < 1e-6));
    Ok(())
}

/// Units are the user's: a page has none that nobody has said.
#[test]
fn axes_have_the_units_of_a_scene_in_the_si() -> Result<(), Box<dyn std::error::Error>> {
    let kernel = Pendulum {}.kernel()?;
    let path = Simulation::new(&kernel).adaptive(1e-9, 1e-9).run(SVector::zeros(), SVector::zeros(), 0.0..0.1)?;
    let page =
        || Ok::<_, IntegrationError>(Playback::with_pictures("", &path, 3)?.curve("angle / rad", "a", |s| s.q[0]));
    for (page, si) in
        [(page()?.energy(&kernel), false), (page()?.si().energy(&kernel), true), (page()?.energy(&kernel).si(), true)]
    {
        let data = data(&page.html()?);
        assert_eq!(data["si"], si);
        let units: Vec<_> = data["panels"].as_array().expect("panels").iter().map(|panel| &panel["unit"]).collect();
        assert_eq!(units, ["", "J"], "a title of the user's is left as it is");
    }
    Ok(())
}

/// Names of robots come from strangers: wherever they stand they are text, and nothing of the page is lost behind them.
#[test]
fn names_and_titles_are_text() -> Result<(), Box<dyn std::error::Error>> {
    let kernel = Pendulum {}.kernel()?;
    let path = Simulation::new(&kernel).adaptive(1e-9, 1e-9).run(SVector::zeros(), SVector::zeros(), 0.0..0.1)?;
    let hostile = [
        "{{data}}<img src=x onerror=alert(1)>",
        "{{scripts}}{{style}}",
        "<!--<script>",
        "</script>",
        "]]>",
        "{{",
        "}}",
    ];
    for text in hostile {
        let page = Playback::with_pictures(text, &path, 3)?
            .frames(&kernel)
            .body(text, |_| Isometry3::identity(), [Shape::ball(1.0).colour(text)])
            .curve(text, text, |s| s.t)
            .html()?;
        let data = data(&page);
        assert_eq!(data["title"], text);
        assert_eq!(data["bodies"][2]["name"], text);
        assert_eq!(data["panels"][0]["curves"][0]["name"], text);
        let title = text.replace('&', "&amp;").replace('<', "&lt;");
        assert!(page.contains(&format!("<title>{title}</title>")), "{text}");
        let open = |mark: &str| page.matches(mark).count();
        assert_eq!((open("<script"), open("</script>"), open("<img"), open("<!--")), (2, 2, 0, 0), "{text}");
    }
    Ok(())
}

#[test]
fn all_mistakes_are_told_at_once() -> Result<(), Box<dyn std::error::Error>> {
    let kernel = Pendulum {}.kernel()?;
    let path = Simulation::new(&kernel).adaptive(1e-9, 1e-9).run(SVector::zeros(), SVector::zeros(), 0.0..0.1)?;
    let page = Playback::new("", &path)?
        .frames(&kernel)
        .frames(&kernel)
        .trace("hand", [0.0; 3])
        .shape("upper", Shape::ball(f64::NAN))
        .shape("upper", Shape::of_inertia(1.0, [0.0; 3], &Matrix3::from_element(f64::NAN)))
        .shape("upper", Shape::of_inertia(0.0, [0.0; 3], &Matrix3::identity()))
        .rod("upper", "lower", f64::NAN)
        .trace("upper", [f64::INFINITY; 3])
        .body("far", |_| Isometry3::translation(1e39, 0.0, 0.0), [])
        .arrow("pull", 1.0, |_| (Vector3::zeros(), Vector3::repeat(-1e300)))
        .curve("", "gap", |s| 1.0 / s.t);
    let Err(PlaybackError::Mistakes(all)) = page.html() else { panic!("mistakes") };
    let expected = [
        "two bodies are called `upper`",
        "two bodies are called `lower`",
        "no body is called `hand`; there are upper, lower, upper, lower",
        "a shape of `upper` is not finite, or larger than a page can show (1.7e38)",
        "a shape of `upper` is not finite, or larger than a page can show (1.7e38)",
        "a shape of `upper` is not finite, or larger than a page can show (1.7e38)",
        "the rod from `upper` to `lower` has the radius NaN",
        "the point of a trace of `upper` is not finite, or larger than a page can show (1.7e38)",
        "the pose of `far` is not finite, or larger than a page can show (1.7e38) at t = 0",
        "the arrow `pull` is not finite, or larger than a page can show (1.7e38) at t = 0",
        "the curve `gap` is not finite at t = 0",
    ];
    assert_eq!(all, expected);
    Ok(())
}

#[test]
fn an_ellipsoid_has_the_moments_it_is_drawn_for() {
    // m/5 (b² + c²), …, turned.
    let (mass, semi_axes) = (3.0, [0.2, 0.5, 0.3]);
    let squares = semi_axes.map(|a: f64| a * a);
    let moments = [1, 2, 0].map(|k| mass / 5.0 * (squares[k] + squares[(k + 1) % 3]));
    let turn = UnitQuaternion::from_euler_angles(0.3, -0.7, 1.1).to_rotation_matrix();
    let inertia = turn * Matrix3::from_diagonal(&Vector3::from(moments)) * turn.transpose();
    let shape = serde_json::to_value(Shape::of_inertia(mass, [0.0; 3], &inertia)).expect("numbers");
    let mut found: Vec<f64> = (0..3).map(|k| shape["size"][k].as_f64().expect("a number")).collect();
    found.sort_by(f64::total_cmp);
    for (found, expected) in found.into_iter().zip([0.2, 0.3, 0.5]) {
        assert!((found - expected).abs() < 1e-14);
    }
    // A planet: its moments are larger than an `f32`, its axes are not.
    let planet = serde_json::to_value(Shape::of_inertia(1.9e27, [0.0; 3], &Matrix3::from_diagonal_element(3e42)));
    let radius = planet.expect("numbers")["size"][0].as_f64().expect("a number");
    assert!((radius / (2.5e42 * 3.0 / 1.9e27_f64).sqrt() - 1.0).abs() < 1e-14);
}

/// A ball that keeps four fifths of its speed at each bounce.
#[derive(GaussDynamics)]
#[gauss(coordinates(height), particle(mass = 1, position = [0, 0, height]), gravity = 9.81)]
struct Ball {}

/// Speeds jump at a bounce: the page has the one before and the one after, a rounding of the time apart, and curves go
/// straight up between them.
#[test]
fn a_jump_is_a_jump() -> Result<(), Box<dyn std::error::Error>> {
    let kernel = Ball {}.kernel()?;
    let run = Simulation::new(&kernel)
        .event(Crossing::Falling, |_, q: &SVector<f64, 1>, _| q[0])
        .then(|state| state.z[0] *= -0.8)
        .adaptive(1e-10, 1e-10)
        .run(SVector::from([1.0]), SVector::from([0.0]), 0.0..2.0)?;
    // Few pictures, so that none is at a bounce by chance.
    let page = Playback::with_pictures("A ball", &run, 21)?.curve("speed", "speed", |s| s.z[0]).html()?;
    let data = data(&page);
    let numbers = |value: &Value| -> Vec<f64> {
        value.as_array().expect("a list").iter().map(|x| x.as_f64().expect("a number")).collect()
    };
    let (times, speeds) = (numbers(&data["times"]), numbers(&data["panels"][0]["curves"][0]["values"]));
    assert_eq!(times.len(), 21 + 2 * run.events().len());
    assert!(times.is_sorted_by(|a, b| a < b));
    for event in run.events() {
        let after = times.iter().position(|t| *t == event.sample.t).expect("a picture");
        assert_eq!(times[after - 1], event.sample.t.next_down());
        // A rounding of the time, at g.
        assert!((speeds[after - 1] - event.sample.z[0]).abs() < 1e-13);
        assert!((speeds[after] + 0.8 * event.sample.z[0]).abs() < 1e-13);
    }
    Ok(())
}

/// Numbers of which there is not one for each time are told, all together.
#[test]
fn a_recording_has_a_number_for_each_time() {
    let poses = [Isometry3::identity(), Isometry3::translation(1.0, 0.0, 0.0)];
    let page = Recording::new("two", vec![0.0, 1.0]).body("ball", &poses, [Shape::ball(0.1)]);
    assert!(page.curve("x / m", "x", vec![0.0, 1.0]).html().is_ok_and(|html| html.contains("\"ball\"")));
    let wrong = Recording::new("two", vec![0.0, f64::NAN]).body("ball", &poses[..1], []).curve("x", "x", vec![1.0; 3]);
    let told = wrong.curve("y", "y", vec![1.0, 2.0, f64::INFINITY]).html().expect_err("mistakes").to_string();
    let expected = [
        "a sample is at the time NaN",
        "the pose of `ball` has 1 values at 2 times",
        "the curve `x` has 3 values at 2 times",
        "the curve `y` has 3 values at 2 times",
        "the curve `y` is not finite at t = NaN",
    ];
    assert_eq!(told, expected.join("; "));
}
