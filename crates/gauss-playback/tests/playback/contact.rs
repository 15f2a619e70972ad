//! Contacts of a run on the page: where they are, what they do, their forces.
#![cfg(feature = "contact")]

use gauss_contact::{ContactRun, WithContacts};
use gauss_playback::{Playback, PlaybackError, Touch};
use gauss_runtime::contact::ContactFrame;
use gauss_runtime::prelude::*;
use serde_json::Value;

/// A block that is thrown onto a floor, slides along it and stops; with a wall that it does not reach.
#[derive(GaussDynamics)]
#[gauss(
    coordinates(x, z),
    particle(mass = 2, position = [x, 0, z]),
    contact(floor, point = [x, 0, z], friction = 0.5),
    contact(wall, gap = 3 - x),
)]
struct Block {
    #[gauss(gravity)]
    g: f64,
}

fn data(page: &str) -> Value {
    let (_, rest) = page.split_once("<script id=\"data\" type=\"application/json\">").expect("the mark of the data");
    let (data, _) = rest.split_once("</script>").expect("the end of the data");
    serde_json::from_str(data).expect("JSON")
}

fn contacts(page: &str) -> Vec<Value> {
    let data = data(page);
    let mut contacts = data["contacts"].as_array().expect("a list").clone();
    contacts.push(data["times"].clone());
    contacts
}

fn numbers(row: &Value) -> Vec<f64> {
    row.as_array().expect("a list").iter().map(|number| number.as_f64().expect("a number")).collect()
}

#[test]
fn contacts_have_places_modes_and_forces() -> Result<(), Box<dyn std::error::Error>> {
    let kernel = Block { g: 10.0 }.kernel()?;
    let run = ContactRun::new(&kernel).adaptive(1e-10, 1e-10);
    let run = run.run([0.0, 0.2].into(), [2.0, 0.0].into(), 0.0..1.0)?;
    // Of the wall the kernel knows no place.
    let wall = |n: usize, s: &Sample<BlockKernel>| {
        (n == 1).then(|| ContactFrame::new(Vector3::new(3.0, 0.0, s.q[1]), -Vector3::x(), &[]))
    };
    let bare = Playback::new("A block", &run)?.contacts(&kernel, 0.1, &run).html()?;
    let page = Playback::new("A block", &run)?.contacts_at(&kernel, 0.1, &run, wall).html()?;
    assert_eq!(contacts(&bare).len(), 2, "the floor, and the times");
    let shown = contacts(&page);
    let [floor, wall, times] = &shown[..] else { panic!("two contacts and the times") };
    assert_eq!((floor, &wall["name"]), (&contacts(&bare)[0], &Value::from("wall")));

    // It falls for 0.2 s. Of 2 m/s half of what stops the fall is lost by friction of the impact, the rest at 5 m/s².
    let stops = 0.2 + (2.0 - 0.5 * 2.0) / 5.0;
    let times = numbers(times);
    let mut seen = [0; 3];
    for (n, t) in times.iter().enumerate() {
        let (touch, friction) = match t {
            t if *t < 0.2 => ("open", None),
            t if *t < stops => ("slides", Some(-10.0)),
            _ => ("sticks", Some(0.0)),
        };
        // Events are known to the tolerance of the run.
        if [0.2, stops].iter().all(|event| (t - event).abs() > 1e-9) {
            assert_eq!(floor["touches"][n], touch, "{t}");
            let row = numbers(&floor["values"][n]);
            let force = [friction.unwrap_or(0.0), 0.0, if friction.is_some() { 20.0 } else { 0.0 }];
            // Floats of 24 bits.
            assert!((0..3).all(|k| (row[3 + k] - 0.1 * force[k]).abs() < 1e-6), "{t} {row:?}");
            assert!(row[2] > -1e-6 && (row[2] < 1e-6) == (touch != "open"), "{t} {row:?}");
            seen[["open", "slides", "sticks"].iter().position(|name| *name == touch).expect("one of them")] += 1;
        }
        assert_eq!(wall["touches"][n], "open");
    }
    assert!(seen.iter().all(|count| *count > 50), "{seen:?}");
    // Before and after each event, so that nothing is smoothed.
    let near = |event: f64| times.iter().filter(|t| (*t - event).abs() < 1e-9).count();
    assert!(near(0.2) >= 2 && near(stops) >= 2 && times.is_sorted_by(|a, b| a < b));
    Ok(())
}

#[test]
fn a_contact_by_hand_and_a_run_of_other_times() -> Result<(), Box<dyn std::error::Error>> {
    let kernel = Block { g: 10.0 }.kernel()?;
    let run = ContactRun::new(&kernel).adaptive(1e-10, 1e-10);
    let run = run.run([0.0, 0.0].into(), [0.0, 0.0].into(), 0.0..1.0)?;
    let samples = run.at_times([0.0, 0.5])?;
    let by_hand = |s: &Sample<BlockKernel>| {
        let touch = if s.t > 0.2 { Touch::Closed } else { Touch::Open };
        (touch, Vector3::new(s.t, 0.0, 0.0), Vector3::repeat(f64::NAN) * (s.t - 0.5))
    };
    let page = Playback::of_samples("", samples.clone()).contact("foot", 1.0, by_hand).html();
    let Err(PlaybackError::Mistakes(all)) = page else { panic!("a mistake") };
    assert_eq!(all, ["the contact `foot` is not finite, or larger than a page can show (1.7e38) at t = 0"]);
    let later = samples.into_iter().map(|s| Sample { t: s.t + 2.0, ..s }).collect();
    let page = Playback::of_samples("", later).contacts(&kernel, 1.0, &run).html();
    let Err(PlaybackError::Mistakes(all)) = page else { panic!("a mistake") };
    assert!(all.len() == 1 && all[0].starts_with("contact `floor`: "), "{all:?}");
    Ok(())
}

/// A block on a slope of 30°, of which the plane is drawn; of steps as of events.
#[derive(GaussDynamics)]
#[gauss(
    coordinates(x, z),
    particle(mass = 2, position = [x, 0, z]),
    contact(slope, point = [x, 0, z], plane = [3, 0, 4], height = 0.5, friction = 0.1),
)]
struct Slope {
    #[gauss(gravity)]
    g: f64,
}

#[test]
fn the_plane_of_a_slope_is_drawn() -> Result<(), Box<dyn std::error::Error>> {
    let kernel = Slope { g: 9.81 }.kernel()?;
    let start = ([0.0, 0.8].into(), [0.0, 0.0].into());
    let exact = Simulation::new(&kernel).adaptive(1e-9, 1e-9).contact_events().run(start.0, start.1, 0.0..1.0)?;
    let steps = Simulation::new(&kernel).contact_steps(1e-2).run(start.0, start.1, 0.0..1.0)?;
    let pages = [
        Playback::new("A slope", &exact)?.contacts(&kernel, 0.1, &exact).html()?,
        Playback::new("A slope", &steps)?.contacts(&kernel, 0.1, &steps).html()?,
    ];
    for page in pages {
        let planes = data(&page)["planes"].as_array().expect("a list").clone();
        let [plane] = &planes[..] else { panic!("one plane: {planes:?}") };
        // A plane at a distance of 0.5 from Ω, whatever the length of the normal that is written.
        let numbers = [numbers(&plane["normal"]), vec![plane["height"].as_f64().expect("a number")]].concat();
        let expected = [0.6, 0.0, 0.8, 0.5];
        // Floats of 24 bits.
        assert!(numbers.iter().zip(expected).all(|(a, b)| (a - b).abs() < 1e-7), "{numbers:?}");
    }
    Ok(())
}
