//! Every scene, wherever its sliders are.

use gauss_web::scenes::{ALL, Entry};

/// Places of the numbers that every scene has.
const KINETIC: usize = 1;
const ERROR: usize = 3;

/// Sliders in the corners of their ranges, by a number whose digits to the base three say which end or where they are
/// at first.
fn placed(scene: &Entry, mut corner: usize) -> Vec<(usize, f64)> {
    let place = |(k, slider): (usize, &gauss_web::scene::Slider)| {
        let digit = corner % 3;
        corner /= 3;
        (k, [slider.value, slider.range[0], slider.range[1]][digit])
    };
    scene.sliders.iter().enumerate().map(place).collect()
}

#[test]
fn energy_is_kept_wherever_the_sliders_are() {
    for (n, scene) in ALL.iter().enumerate() {
        for corner in (0..3_usize.pow(scene.sliders.len() as u32)).step_by(7) {
            let mut motion = (scene.open)().expect("parameters of a body");
            let refused = placed(scene, corner).into_iter().find_map(|(k, value)| motion.set(k, value).err());
            if let Some(message) = refused {
                // The racket's moments can be set to what no body has; the page then says so.
                assert!(n == 1 && message.contains("principal moment"), "scene {n}, corner {corner}: {message}");
                continue;
            }
            for _ in 0..30 {
                motion.advance(1.0 / 60.0, 1e-9).unwrap_or_else(|error| panic!("scene {n}, corner {corner}: {error}"));
            }
            let numbers = motion.numbers();
            assert!(numbers.iter().all(|number| number.is_finite()), "scene {n}, corner {corner}: {numbers:?}");
            // Some hundred steps at most, each within 1e-9 of each component; of speeds that are small beside the
            // fastest one, energy has no more digits than these.
            let error = numbers[ERROR].abs();
            assert!(error < 1e-5 || numbers[KINETIC] < 1e-9, "scene {n}, corner {corner}: {error}");
        }
    }
}

#[test]
fn a_parameter_changes_while_it_runs_and_a_start_begins_anew() {
    for (n, scene) in ALL.iter().enumerate() {
        let mut motion = (scene.open)().expect("parameters of a body");
        for _ in 0..10 {
            motion.advance(0.01, 1e-9).expect("it goes on");
        }
        let before = motion.numbers();
        let of =
            |parameter| scene.sliders.iter().position(|slider| slider.parameter == parameter).expect("one of both");
        let (parameter, start) = (of(true), of(false));
        let moved = |k: usize| 0.5 * (scene.sliders[k].value + scene.sliders[k].range[1]);
        motion.set(parameter, moved(parameter)).expect("parameters of a body");
        assert_eq!(motion.numbers()[0], before[0], "scene {n}: it goes on");
        assert_eq!(motion.numbers()[ERROR], 0.0, "scene {n}: another kernel has another energy");
        motion.set(start, moved(start)).expect("a start");
        assert_eq!(motion.numbers()[0], 0.0, "scene {n}: it begins anew");
    }
}

#[test]
fn what_no_body_has_is_said_and_changes_nothing() {
    let racket = &ALL[1];
    let mut motion = (racket.open)().expect("parameters of a body");
    let before = motion.numbers();
    assert_eq!(racket.sliders[2].name, "I₁, along the handle");
    let message = motion.set(2, 100.0).expect_err("larger than the two others together");
    assert!(message.contains("principal moment"), "{message}");
    assert_eq!(motion.numbers(), before);
}

#[test]
fn the_page_shows_the_struct_and_what_was_derived() {
    for scene in &ALL {
        let code = gauss_web::page::derived_struct(scene.source);
        assert!(code.starts_with('#') && code.ends_with("}\n") && code.contains("#[gauss("), "{code}");
        assert!(scene.operations > 0 && !scene.equations.is_empty());
    }
    let page = gauss_web::page::html(b"no module");
    assert!(!page.contains("://"), "a page without network");
    assert_eq!(page.matches("</script>").count(), 2);
}
