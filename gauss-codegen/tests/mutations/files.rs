//! Files of robots, changed tag by tag.

use super::random::Random;

/// The robots of the tests, with the word of the clause that reads each.
const ROBOTS: [(&str, &str); 10] = [
    ("urdf", include_str!("../../../tests/robots/gripper.urdf")),
    ("urdf", include_str!("../../../tests/robots/five_bar.urdf")),
    ("urdf", include_str!("../../../tests/robots/panda.urdf")),
    ("urdf", include_str!("../../../tests/robots/robotiq_2f_85.urdf")),
    ("urdf", include_str!("../../../tests/robots/anymal.urdf")),
    ("mjcf", include_str!("../../../tests/robots/linkage.xml")),
    ("mjcf", include_str!("../../../tests/robots/loop.xml")),
    ("mjcf", include_str!("../../../tests/robots/quadrotor.xml")),
    ("urdf", include_str!("../../../tests/robots/shapes.urdf")),
    ("mjcf", include_str!("../../../tests/robots/footed.xml")),
];

const VALUES: &str = "0 1 -1 0.5 1e308 1e-308 1e19 3.4e38 1e400 nan inf 90 true false all main x y z body joint fixed revolute ball free \
    hinge slide prismatic continuous planar floating world base degree radian mesh box capsule";

const WORDS: &str = "body joint link geom inertial origin mass inertia axis limit dynamics mimic default frame site general motor position \
    velocity equality connect weld tendon fixed spatial actuator include keyframe key compiler option freejoint file name class \
    childclass type pos quat euler axisangle range ref contype conaffinity condim friction size fromto collision stiffness damping armature gear kp kv xyz rpy parent child";

/// A file, and the word that reads it.
pub struct Robot {
    pub format: &'static str,
    pub text: String,
}

/// A changed file.
pub fn robot(random: &mut Random) -> Robot {
    let pair = [0; 2].map(|_| random.below(ROBOTS.len()));
    let (format, text) = pair.into_iter().map(|k| ROBOTS[k]).min_by_key(|(_, text)| text.len()).expect("two of them");
    let other = pieces(ROBOTS[random.below(ROBOTS.len())].1);
    let mut parts = pieces(text);
    for _ in 0..1 + random.below(5) {
        change(&mut parts, &other, random);
    }
    Robot { format, text: parts.concat() }
}

/// Tags, and what stands between them.
fn pieces(text: &str) -> Vec<String> {
    let mut pieces = Vec::new();
    let mut rest = text;
    while !rest.is_empty() {
        let end = match rest.starts_with('<') {
            true => rest.find('>').map_or(rest.len(), |end| end + 1),
            false => rest.find('<').unwrap_or(rest.len()),
        };
        let (piece, after) = rest.split_at(end);
        pieces.push(piece.to_owned());
        rest = after;
    }
    pieces
}

fn change(parts: &mut Vec<String>, other: &[String], random: &mut Random) {
    if parts.is_empty() {
        return parts.extend(other.iter().cloned());
    }
    let (k, j) = (random.below(parts.len()), random.below(parts.len()));
    let (from, to) = (k.min(j), k.max(j));
    match random.below(12) {
        0 => _ = parts.remove(k),
        1 => parts.insert(k, parts[j].clone()),
        2 => parts.swap(k, j),
        3 => parts.insert(k, random.of(other).clone()),
        4 => _ = parts.drain(from..to.min(from + 8)),
        5 => {
            let copy = parts[from..=to.min(from + 8)].to_vec();
            let most = *random.of(&[2, 5, 40]);
            (0..1 + random.below(most)).for_each(|_| _ = parts.splice(k..k, copy.clone()));
        }
        6 => nest(parts, k, random),
        7 => {
            let character = *random.of(&['<', '>', '"', '\'', '&', '/', '=', '!', ' ', '\u{e9}', '\0']);
            let place = random.below(parts[k].chars().count() + 1);
            let (before, after): (Vec<_>, Vec<_>) = parts[k].chars().enumerate().partition(|(n, _)| *n < place);
            let chars = before.into_iter().map(|(_, c)| c).chain([character]).chain(after.into_iter().map(|(_, c)| c));
            parts[k] = chars.collect();
        }
        _ => value(&mut parts[k], random),
    }
}

/// The tag around its own copies.
fn nest(parts: &mut Vec<String>, k: usize, random: &mut Random) {
    let Some(name) = parts[k].strip_prefix('<').filter(|rest| rest.starts_with(char::is_alphabetic)) else { return };
    let name: String = name.chars().take_while(|c| c.is_alphanumeric()).collect();
    let open = parts[k].replace("/>", ">");
    let times = *random.of(&[1, 3, 30, 300, 3000]);
    parts.splice(k..k, std::iter::repeat_n(open, times));
    let end = (k + times + 1).min(parts.len());
    parts.splice(end..end, std::iter::repeat_n(format!("</{name}>"), times));
}

/// One word of a tag becomes another, or a quoted value does.
fn value(part: &mut String, random: &mut Random) {
    let mut quoted: Vec<String> = part.split('"').map(str::to_owned).collect();
    let words = |list: &'static str| list.split_whitespace().collect::<Vec<&str>>();
    if quoted.len() < 3 || random.below(5) == 0 {
        let written: Vec<&str> = part.split_whitespace().collect();
        if let Some(old) = (!written.is_empty()).then(|| written[random.below(written.len())].to_owned()) {
            let new = random.of::<&str>(&words(WORDS)).to_owned();
            *part = part.replacen(&old, &if old.starts_with('<') { format!("<{new}") } else { new.to_owned() }, 1);
        }
        return;
    }
    let place = 1 + 2 * random.below(quoted.len() / 2);
    let values = words(VALUES);
    let mut numbers: Vec<String> = quoted[place].split_whitespace().map(str::to_owned).collect();
    match random.below(4) {
        0 if !numbers.is_empty() => {
            let k = random.below(numbers.len());
            numbers.insert(k, random.of::<&str>(&values).to_string());
        }
        1 if !numbers.is_empty() => _ = numbers.pop(),
        _ if !numbers.is_empty() => {
            let k = random.below(numbers.len());
            numbers[k] = random.of::<&str>(&values).to_string();
        }
        _ => numbers.push(random.of::<&str>(&values).to_string()),
    }
    quoted[place] = numbers.join(" ");
    *part = quoted.join("\"");
}
