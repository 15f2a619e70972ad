//! What is too long, too deep or too large is refused at its place before time, memory or the stack run out; the rest
//! works.

use std::thread;
use std::time::{Duration, Instant};

use gauss_codegen::{expand, item};

#[path = "common/computed.rs"]
mod computed;

/// As long as anyone waits for a derive, of a processor that may be shared.
const PATIENCE: Duration = Duration::from_secs(10);
/// Half of what the compiler has.
const STACK: usize = 4 << 20;
/// A limit below the usual one, of which an unoptimised build would derive for ten seconds.
const FEW: usize = 10_000;

/// A particle in the plane, with more clauses.
fn plane(clauses: &str) -> String {
    format!(
        "#[gauss(coordinates(x, y), particle(mass = m, position = [x, y, 0]), {clauses})] struct Scene {{ m: f64, k: f64 }}"
    )
}

fn listed(count: usize, separator: &str, entry: impl Fn(usize) -> String) -> String {
    (0..count).map(entry).collect::<Vec<_>>().join(separator)
}

/// The first message, if there is one.
#[track_caller]
fn derived(source: String) -> Option<String> {
    let shown: String = source.chars().take(200).collect();
    let (message, took) = said(source);
    assert!(took < PATIENCE, "{took:?}: {shown}");
    message
}

/// The same, and how long it takes.
fn said(source: String) -> (Option<String>, Duration) {
    let work = move || {
        let begun = Instant::now();
        let tokens = source.parse().expect("tokens");
        let message = item(tokens).and_then(|input| expand(&input)).err().map(|mistake| mistake.to_string());
        (message, computed::computed(begun))
    };
    let worker = thread::Builder::new().stack_size(STACK).spawn(work).expect("a thread");
    worker.join().expect("no panic")
}

#[track_caller]
fn works(source: String) {
    assert_eq!(derived(source), None);
}

#[track_caller]
fn refused(source: String, message: &str) {
    let found = derived(source).expect("it is refused");
    assert!(found.contains(message), "{found}");
}

#[test]
fn definitions_that_square_one_another() {
    let squarings = |count: usize| {
        let squares = listed(count, ", ", |k| format!("d{} = d{k} * d{k}", k + 1));
        plane(&format!("define(d0 = x + y, {squares}), potential = d{count}"))
    };
    works(squarings(5));
    refused(squarings(10), "100 factors at most");
    refused(squarings(20), "more than 100000 parts");
    refused(squarings(40), "more than 100000 parts");
}

#[test]
fn powers() {
    works(plane("potential = powi(x + k * y, 100)"));
    works(plane("potential = powi(powi(cos(x) + y, 9) + sin(y), 9)"));
    refused(plane("potential = powi(x, 1000)"), "100 factors at most");
    let nested = (0..9).fold("x".to_owned(), |base, _| format!("powi({base}, 100)"));
    refused(plane(&format!("potential = {nested}")), "100 factors at most");
    refused(plane(&format!("potential = {}", listed(500, " * ", |_| "x".into()))), "100 factors at most");
}

#[test]
fn long_chains_of_operators() {
    works(plane(&format!("drive(x = {})", listed(1000, " - ", |k| format!("{k} * sin(y)")))));
    works(plane(&format!("potential = {}", listed(300, " + ", |k| format!("k * cos({} * x)", k + 1)))));
    works(plane(&format!("drive(x = {})", listed(300, " * ", |k| format!("cos({} * x)", k + 1)))));
    works(plane(&format!("drive(x = k / {})", listed(90, " / ", |_| "(2 + cos(x))".into()))));
    works(plane(&format!("potential = {}", listed(40, " * ", |k| format!("(x + {} * y)", k + 1)))));
}

#[test]
fn depth() {
    let nested = |count: usize, before: &str, after: &str| {
        plane(&format!("drive(x = {}x{})", before.repeat(count), after.repeat(count)))
    };
    for (before, after) in [("(", ")"), ("sin(", ")"), ("sqrt(1 + ", ")"), ("", ".sin()")] {
        works(nested(100, before, after));
        refused(nested(400, before, after), "`x` is nested more than 128 levels deep");
        refused(nested(1000, before, after), "nested more than 128 levels deep");
        refused(nested(30_000, before, after), "nested more than 128 levels deep");
    }
    for (before, after) in
        [("-", ""), ("!", ""), ("[", "]"), ("&", ""), ("x = ", ""), ("|x| ", ""), ("if x {} else ", "")]
    {
        refused(nested(1000, before, after), "nested more than 128 levels deep");
    }
    works(plane(&format!("potential = {}x{}", "sin(".repeat(100), ")".repeat(100))));
    let types = format!("struct Scene {{ m: {}f64{} }}", "Vector3<".repeat(1000), ">".repeat(1000));
    refused(types, "nested more than 128 levels deep");
    let documented = format!("#[doc = {}x{}] struct Scene {{ m: f64 }}", "abs(".repeat(300), ")".repeat(300));
    refused(documented, "nested more than 128 levels deep");
    // Each is shallow.
    let deeper = listed(20, ", ", |k| format!("d{} = {}d{k}{}", k + 1, "sin(".repeat(50), ")".repeat(50)));
    refused(plane(&format!("define(d0 = x, {deeper}), drive(x = d20)")), "`d6` is nested more than 256 levels deep");
}

#[test]
fn many_bodies() {
    let frames = |count: usize| {
        let next = |k: usize| {
            let before = if k > 0 { format!("parent = f{}, ", k - 1) } else { String::new() };
            format!("frame(f{k}, {before}position = [k, x, 0], rotation = rotation_{}(y))", ["x", "z"][k % 2])
        };
        let last = count - 1;
        let frames = listed(count, ", ", next);
        format!(
            "#[gauss(coordinates(x, y), limit = {FEW}, {frames}, \
             particle(mass = m, parent = f{last}, position = [k, 0, 0]))] struct Scene {{ m: f64, k: f64 }}"
        )
    };
    works(frames(17));
    let message = format!("the equations are made of more expressions than {FEW} operations can come of");
    refused(frames(300), &message);
    let apart = |k: usize| format!("particle(mass = m, position = [q{k}, 0, 0])");
    works(format!(
        "#[gauss(coordinates({}), {})] struct Scene {{ m: f64 }}",
        listed(100, ", ", |k| format!("q{k}")),
        listed(100, ", ", apart)
    ));
}

/// Angles that are functions of functions: squares of their cosines would be written by sines, 2ⁿ terms for n of them.
#[test]
fn angles_of_functions() {
    for count in [24, 60] {
        let angle = format!("{}x + y{}", "sin(".repeat(count), ")".repeat(count));
        let source = format!(
            "#[gauss(coordinates(x, y), body(arm, position = [x, y, 0], rotation = rotation_z({angle}), mass = m, inertia = k), \
               body(hand, parent = arm, position = [1, x, 0], rotation = rotation_x({angle}), mass = m, inertia = k))] \
               struct Scene {{ m: f64, k: f64 }}"
        );
        let found = derived(source);
        assert!(found.as_ref().is_none_or(|message| message.contains("more")), "{found:?}");
    }
    works(plane("potential = powi(cos(x), 100) * powi(cos(y), 99) * powi(cos(k * x), 51)"));
}

/// Numbers that are in range each, and whose products are not.
#[test]
fn constants_beyond_their_range() {
    let lost = "beyond the range of double precision";
    refused(plane("drive(x = 1e-200 * y * 1e-200)"), lost);
    refused(plane("drive(x = 1e200 * y * 1e200)"), lost);
    refused(plane("drive(x = 1e300 * 1e300 / 1e300)"), lost);
    refused(plane("define(a = 1e-200 * y), drive(x = a * (k + x) * 1e-200)"), lost);
    // In the square of the velocity.
    let light = "#[gauss(coordinates(x), particle(mass = 1e-100, position = [1e-150 * x, 0, 0]), drive(x = 1e-300))] struct \
                 Light {}";
    refused(light.to_owned(), lost);
    refused(plane("drive(x = 1e-30 * y * 1e-30)").replace("f64", "f32"), "beyond the range of single precision");
    works(plane("drive(x = 1e-150 * y * 1e-150)"));
    // Rounding leaves nothing of this turn; that is no loss.
    works(plane("force(at = [x, y, 0], value = rotation_x(0.5) * rotation_x(-0.5) * [0, k, 0])"));
    works(plane("drive(x = 1e-200 * y * 1e200)"));
}

/// Two legs with wheels, of which one has moments that rounding left of zeros, and the other its centre of mass so near
/// to its axis that the square of that is nothing beside its moments: a difference of them is zero in doubles. Nothing
/// is lost by that.
#[test]
fn small_numbers_beside_zeros_of_rounding() {
    let leg = |name: &str, side: f64, off: &str, small: &str| {
        format!(
            "body({name}, position = [0.2, {side}, 0.1], rotation = rotation_z(-{name}_turn), mass = 0.4,
                 center_of_mass = [0, 0.04, -0.03], inertia_about_center_of_mass = [7e-4, 0, 0, 6e-4, 2e-4, 4e-4]),
             body({name}_wheel, parent = {name}, position = [0, 0.04, -0.1], rotation = rotation_y(-{name}_roll), mass = 3.7,
                 center_of_mass = [{off}, -0.04, 0],
                 inertia_about_center_of_mass = [0.00676, 0, {small}, 0.01139, 0, 0.00676])"
        )
    };
    let legs = |small: &str, off: &str| {
        format!(
            "#[gauss(coordinates(left_turn, left_roll, right_turn, right_roll), {}, {}, gravity = 9.81)] struct Legs {{}}",
            leg("left", 0.2, "0", small),
            leg("right", -0.2, off, "0")
        )
    };
    for off in ["7.83171e-18", "1e-160"] {
        for small in ["5e-20", "3.107e-22"] {
            works(legs(small, off));
        }
        // Smaller ones may be taken for lost, but never in silence.
        let found = derived(legs("1e-40", off));
        let lost = "beyond the range of double precision";
        assert!(found.as_ref().is_none_or(|message| message.contains(lost)), "{found:?}");
    }
}

/// Accelerations in range, with products that are not, are no mistake of the equations.
#[test]
fn checks_out_of_range() {
    let huge = "define(h = exp(exp(dot([x, 3, 1], [3, 2, x]) * dot([x, 3, 1], [3, 2, x]))) * y)";
    let found = derived(plane(&format!("{huge}, drive(y = k - h), force(at = [x, y, ln(h)], value = [k, 0, 1])")));
    assert!(found.as_ref().is_none_or(|message| !message.contains("bug")), "{found:?}");
}

/// What a file of many links is refused for is found before everything is derived, and names are not looked for one by
/// one.
#[cfg(feature = "urdf")]
#[test]
fn many_links() {
    for count in [300, 10_000] {
        let link = |k: usize| {
            let parent = if k == 0 { "base".to_owned() } else { format!("l{}", k - 1) };
            let axis = ["0 0 1", "0 1 0", "1 0 0"][k % 3];
            format!(
                "<joint name=\"j{k}\" type=\"revolute\"><parent link=\"{parent}\"/><child link=\"l{k}\"/>\
                 <axis xyz=\"{axis}\"/><origin xyz=\"0 0.05 0.{}\"/></joint>\
                 <link name=\"l{k}\"><inertial><mass value=\"2.{k}\"/><inertia ixx=\"0.1\" iyy=\"0.1\" izz=\"0.1\"/>\
                 </inertial></link>",
                200 + k
            )
        };
        let text = format!("<robot name=\"r\"><link name=\"base\"/>{}</robot>", listed(count, "", link));
        let path = std::env::temp_dir().join(format!("gauss-links-{}-{count}.urdf", std::process::id()));
        std::fs::write(&path, text).expect("a folder for files that do not stay");
        let found = derived(format!("#[gauss(urdf = {path:?}, gravity = 9.81, limit = {FEW})] struct Robot;"));
        // What is left behind harms nobody.
        let _ = std::fs::remove_file(&path);
        let message = format!("the equations are made of more expressions than {FEW} operations can come of");
        assert!(found.is_some_and(|found| found.contains(&message)), "{count} links");
    }
}

/// A file of a hundred links, ten limbs of ten, whose numbers are all different, derived, checked and written: one to
/// two seconds of a quiet processor. It has 78,000 operations.
#[cfg(feature = "urdf")]
#[test]
fn a_hundred_links() {
    let limb = |k: usize| {
        let parent = if k.is_multiple_of(10) { "base".to_owned() } else { format!("l{}", k - 1) };
        let axis = ["0 0 1", "0 1 0", "1 0 0"][k % 3];
        format!(
            "<joint name=\"j{k}\" type=\"revolute\"><parent link=\"{parent}\"/><child link=\"l{k}\"/>\
             <axis xyz=\"{axis}\"/><origin xyz=\"0 0.05 0.{}\"/></joint>\
             <link name=\"l{k}\"><inertial><origin xyz=\"0.01 0.02 0.1\"/><mass value=\"2.{k}\"/>\
             <inertia ixx=\"0.1\" iyy=\"0.11\" izz=\"0.05\"/></inertial></link>",
            200 + k
        )
    };
    let text = format!("<robot name=\"r\"><link name=\"base\"/>{}</robot>", listed(100, "\n", limb));
    let path = std::env::temp_dir().join(format!("gauss-hundred-{}.urdf", std::process::id()));
    std::fs::write(&path, text).expect("a folder for files that do not stay");
    let (found, _) = said(format!("#[gauss(urdf = {path:?}, gravity = 9.81, limit = 100000)] struct Robot;"));
    // What is left behind harms nobody.
    let _ = std::fs::remove_file(&path);
    assert_eq!(found, None);
}

/// A file in a folder of its own, which is gone after the test.
#[cfg(any(feature = "urdf", feature = "mjcf"))]
struct Folder(std::path::PathBuf);

#[cfg(any(feature = "urdf", feature = "mjcf"))]
impl Folder {
    fn new(name: &str) -> Self {
        let path = std::env::temp_dir().join(format!("gauss-{name}-{}", std::process::id()));
        std::fs::create_dir_all(&path).expect("a folder for files that do not stay");
        Self(path)
    }

    fn write(&self, name: &str, text: &str) -> std::path::PathBuf {
        let path = self.0.join(name);
        std::fs::write(&path, text).expect("a folder that can be written");
        path
    }

    /// The struct of a file of this folder.
    fn of(&self, format: &str, text: &str) -> String {
        format!("#[gauss({format} = {:?})] struct Robot;", self.write(&format!("main.{format}"), text))
    }
}

#[cfg(any(feature = "urdf", feature = "mjcf"))]
impl Drop for Folder {
    fn drop(&mut self) {
        // What is left behind harms nobody.
        let _ = std::fs::remove_dir_all(&self.0);
    }
}

/// Elements in elements, on the stack of a thread; the deepest that are read, and deeper ones.
#[cfg(feature = "mjcf")]
#[test]
fn depth_of_files() {
    let folder = Folder::new("depth");
    let whole = |inside: String| folder.of("mjcf", &format!("<mujoco>{inside}</mujoco>"));
    let nested = |count: usize, open: &str, close: &str| format!("{}{}", open.repeat(count), close.repeat(count));
    let bodies = |count: usize, body: &str| format!("<worldbody>{}</worldbody>", nested(count, body, "</body>"));
    let arm = "<body name=\"arm\"><joint/><geom size=\"1\"/></body>";
    let with_arm = |inside: String| whole(format!("<worldbody>{arm}</worldbody>{inside}"));
    // With the root, the section and what is innermost.
    let most = 256 - 3;
    works(whole(bodies(most, "<body>").replace("<body></body>", arm)));
    let frames = nested(most - 1, "<frame>", "</frame>").replace("<frame></frame>", &format!("<frame>{arm}</frame>"));
    works(whole(format!("<worldbody>{frames}</worldbody>")));
    let classes: String = (0..most + 2).map(|index| format!("<default class=\"c{index}\">")).collect();
    works(with_arm(classes + &"</default>".repeat(most + 2)));
    works(with_arm(nested(most + 2, "<custom>", "</custom>")));
    for count in [most + 3, 3_000, 200_000] {
        refused(whole(bodies(count, "<body>")), "<body> is nested more than 256 levels deep");
        refused(whole(nested(count, "<default>", "</default>")), "<default> is nested more than 256 levels deep");
        refused(whole(nested(count, "<include>", "</include>")), "nested more than 256 levels deep");
        refused(whole(nested(count, "<replicate count=\"1\">", "</replicate>")), "nested more than 256 levels deep");
    }
    refused(whole("<include><include/></include>".to_owned()), "there is nothing in an <include>");
    refused(whole("<x/>".repeat(1_100_000)), "this is no XML: nodes limit reached");
}

#[cfg(feature = "urdf")]
#[test]
fn depth_of_urdf_files() {
    let folder = Folder::new("depth-urdf");
    let whole = |count: usize| {
        folder.of(
            "urdf",
            &format!("<robot>{}{}</robot>", "<transmission>".repeat(count), "</transmission>".repeat(count)),
        )
    };
    for count in [256, 3_000, 200_000] {
        refused(whole(count), "<transmission> is nested more than 256 levels deep");
    }
}

/// What may never end is no file; what is large is cut off.
#[cfg(all(feature = "urdf", feature = "mjcf"))]
#[test]
fn files_that_never_end() {
    let folder = Folder::new("endless");
    let include = |name: &str| folder.of("mjcf", &format!("<mujoco><include file=\"{name}\"/></mujoco>"));
    let endless = if cfg!(unix) { "/dev/zero" } else { "." };
    refused(include(endless), "it is no regular file");
    refused(include("."), "it is no regular file");
    refused(format!("#[gauss(urdf = {endless:?})] struct Robot;"), "it is no regular file");
    refused(format!("#[gauss(mjcf = {:?})] struct Robot;", folder.0), "it is no regular file");
    let blanks = " ".repeat((16 << 20) + 1);
    folder.write("large.xml", &blanks);
    refused(include("large.xml"), "it is larger than 16 MiB");
    let part = format!("<mujoco>{}</mujoco>", " ".repeat(9 << 20));
    folder.write("a.xml", &part);
    folder.write("b.xml", &part);
    let both = "<mujoco><include file=\"a.xml\"/><include file=\"b.xml\"/></mujoco>";
    refused(folder.of("mjcf", both), "with `b.xml` all files together are larger than 16 MiB");
    for k in 0..40 {
        folder.write(&format!("{k}.xml"), &format!("<mujoco><include file=\"{}.xml\"/></mujoco>", k + 1));
    }
    refused(include("0.xml"), "files include each other more than 32 deep");
}

/// What stands twice in each function of a function is doubled 2⁶⁰ times where it is written out: equations and the
/// names of sums leave it out.
#[test]
fn functions_of_what_stands_twice() {
    let nested = |function: &str| (0..60).fold("x * y".to_owned(), |inner, _| format!("{function}({inner})"));
    for position in [format!("[k, ln({}), y]", nested("tan")), format!("[x, {} - y, k]", nested("tanh"))] {
        // Refused or not: it ends.
        let _ = derived(plane(&format!("particle(mass = m, position = {position})")));
    }
}
