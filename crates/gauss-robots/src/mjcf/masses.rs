//! Mass data of bodies: from `<inertial>`, or from the volumes of geoms.

use std::f64::consts::PI;

use roxmltree::Node;

use super::bounds::diagonal_of;
use super::rotations::to_direction;
use super::shells::area_and_moments;
use super::{File, Geoms};
use crate::description::{Inertial, Note};
use crate::rotation::{Rotation, Triple, turned_tensor};
use crate::structure::{placed, sum};
use crate::xml::shown;

const GEOM: &[&str] = &["geom"];

/// kg/m³, of geoms that say nothing; of shells kg/m².
const DENSITY: f64 = 1000.0;

impl<'a> File<'a> {
    /// Mass data that are written for a body, in its axes.
    pub fn inertial(&mut self, node: Node<'a, 'a>, class: Option<&'a str>) -> Option<Inertial> {
        let own = self.said(node, class);
        self.bounds.kept(own)
    }

    fn said(&mut self, node: Node<'a, 'a>, class: Option<&'a str>) -> Option<Inertial> {
        let written = self.framed(node, class, &["inertial"]);
        written.iter().for_each(|(inertial, ..)| self.reading.see(*inertial));
        if let [_, (second, ..), ..] = written.as_slice() {
            self.reading.fault(*second, format!("{} has a second <inertial>", shown(node)));
        }
        match (written.first(), self.geoms) {
            (Some((inertial, _, place)), Geoms::Missing | Geoms::None) => {
                let own = self.written(*inertial)?;
                if *place != ([0.0; 3], Rotation::none().matrix) {
                    let text = "<inertial> is placed by the <frame> that it is in, as of MuJoCo 4, not of 3";
                    self.reading.ignored(*inertial, text);
                }
                Some(placed(own, place))
            }
            (None, Geoms::None) => None,
            _ => self.of_geoms(node, class),
        }
    }

    /// Multiplies all masses, and the inertias with them, by what makes their sum that which the file asks for.
    pub fn scale_masses(&mut self) {
        let Some(wanted) = self.total_mass else { return };
        let own = || self.description.links.iter().filter_map(|link| link.inertial);
        let sum: f64 = own().map(|own| own.mass).sum();
        // Each has a part in all.
        self.reading.notes.extend(self.description.links.iter_mut().flat_map(|link| link.mass_notes.drain(..)));
        if sum > 0.0 {
            for own in self.description.links.iter_mut().filter_map(|link| link.inertial.as_mut()) {
                *own = own.scaled(wanted / sum);
            }
        }
    }

    fn written(&mut self, node: Node<'a, 'a>) -> Option<Inertial> {
        let mass = self.reading.required_number(node, "mass");
        let center: Triple = self.reading.numbers(node, "pos").unwrap_or_default();
        let rotation = self.angles.of(node, &mut self.reading);
        let full: Option<[f64; 6]> = self.reading.numbers(node, "fullinertia");
        let diagonal: Option<Triple> = self.reading.numbers(node, "diaginertia");
        let tensor = match (full, diagonal) {
            (Some([xx, yy, zz, xy, xz, yz]), _) => [[xx, xy, xz], [xy, yy, yz], [xz, yz, zz]],
            (None, Some(moments)) => diagonal_of(moments),
            (None, None) => {
                self.reading.fault(node, "`diaginertia` or `fullinertia` is missing");
                return None;
            }
        };
        if mass.is_some_and(|mass| mass < 0.0) {
            self.reading.fault(node, "a mass is zero or more");
        }
        let inertia = if rotation == Rotation::none() { tensor } else { turned_tensor(&rotation.matrix, &tensor) };
        Some(Inertial { mass: mass?, center, inertia }.settled())
    }

    /// The sum of the geoms of a body, with those in its frames.
    fn of_geoms(&mut self, node: Node<'a, 'a>, class: Option<&'a str>) -> Option<Inertial> {
        let geoms = self.framed(node, class, GEOM);
        let all: Vec<Inertial> = geoms
            .into_iter()
            .filter_map(|(geom, class, place)| Some(placed(self.of_geom(geom, class)?, &place)))
            .collect();
        (!all.is_empty()).then(|| sum(&all))
    }

    /// A volume of one density; `None` of what has none, and of meshes, which is noted.
    fn of_geom(&mut self, node: Node<'a, 'a>, class: Option<&'a str>) -> Option<Inertial> {
        let kind = self.text(node, GEOM, "type", class).unwrap_or("sphere");
        let size = self.list(node, GEOM, "size", class).unwrap_or_default();
        let ends: Option<[f64; 6]> = self.numbers(node, GEOM, "fromto", class);
        let own: Option<[f64; 1]> = self.numbers(node, GEOM, "mass", class);
        let density = self.numbers(node, GEOM, "density", class).map_or(DENSITY, |[density]| density);
        let place = self.triple(node, "geom", "pos", class);
        let rotation = self.rotation(node, GEOM, class);
        let group = self.numbers(node, GEOM, "group", class).map_or(0.0, |[group]| group);
        if group < self.groups[0] || group > self.groups[1] {
            return None;
        }
        if own == Some([0.0]) || (own.is_none() && density == 0.0) || matches!(kind, "plane" | "hfield") {
            return None;
        }
        if let Some(mesh) = self.text(node, GEOM, "mesh", class) {
            // MuJoCo leaves `shellinertia` out here: a mesh has its own `inertia="shell"`.
            let solid = self.of_mesh(node, kind, mesh)?;
            let solid = solid.scaled(own.map_or(density, |[mass]| mass / solid.mass));
            return Some(placed(solid, &(place, rotation.matrix)));
        }
        let is_shell = self.text(node, GEOM, "shellinertia", class) == Some("true");
        let measure = if is_shell { area_and_moments } else { volume_and_moments };
        let (center, matrix, half) = match ends {
            Some([a, b, c, d, e, f]) => {
                let along = [d - a, e - b, f - c];
                let length = along.iter().map(|c| c * c).sum::<f64>().sqrt();
                ([(a + d) / 2.0, (b + e) / 2.0, (c + f) / 2.0], to_direction(along)?, Some(length / 2.0))
            }
            None => (place, rotation.matrix, None),
        };
        let Some((volume, moments)) = measure(kind, &size, half) else {
            let shell = if is_shell { "shell" } else { "<geom>" };
            let text =
                format!("the mass of {} is not read: a {shell} of type `{kind}` needs its mesh or sizes", shown(node));
            self.mass_notes.push(Note::ignored(self.reading.at(node), "geom", text));
            return None;
        };
        if is_shell && kind == "ellipsoid" {
            let text =
                format!("the mass of {} is that of its surface; MuJoCo approximates it, and its moments", shown(node));
            self.mass_notes.push(Note::told(self.reading.at(node), text).about("shells of ellipsoids"));
        }
        let mass = own.map_or(volume * density, |[mass]| mass);
        let inertia = turned_tensor(&matrix, &diagonal_of(moments.map(|moment| moment * mass)));
        Some(Inertial { mass, center, inertia })
    }
}

/// The volume of a shape, and its central moments by mass; `half` its length along the third axis, where its ends say
/// it: what lies between ends is as deep as wide then, whatever the second size, as `mjCGeom::Compile` of MuJoCo's
/// `src/user/user_objects.cc` has it.
pub fn volume_and_moments(kind: &str, size: &[f64], half: Option<f64>) -> Option<(f64, Triple)> {
    let round = || Some((*size.first()?, half.or(size.get(1).copied())?));
    let three = || match half {
        Some(half) => Some([*size.first()?, *size.first()?, half]),
        None => Some([*size.first()?, *size.get(1)?, *size.get(2)?]),
    };
    // Moments from the mean squares of the distances along the axes.
    let of = |volume: f64, [x, y, z]: Triple| (volume, [y + z, z + x, x + y]);
    Some(match kind {
        "sphere" => {
            let r = *size.first()?;
            of(4.0 / 3.0 * PI * r.powi(3), [r * r / 5.0; 3])
        }
        "capsule" => {
            let (r, h) = round()?;
            let (tube, caps) = (2.0 * PI * r * r * h, 4.0 / 3.0 * PI * r.powi(3));
            let volume = tube + caps;
            let across = (tube * r * r / 4.0 + caps * r * r / 5.0) / volume;
            // Of a half ball about its centre: r²/5 and the arm 3 r/8.
            let along = (tube * h * h / 3.0 + caps * (r * r / 5.0 + h * h + 0.75 * r * h)) / volume;
            of(volume, [across, across, along])
        }
        "cylinder" => {
            let (r, h) = round()?;
            of(2.0 * PI * r * r * h, [r * r / 4.0, r * r / 4.0, h * h / 3.0])
        }
        "box" => {
            let [a, b, c] = three()?;
            of(8.0 * a * b * c, [a * a / 3.0, b * b / 3.0, c * c / 3.0])
        }
        "ellipsoid" => {
            let [a, b, c] = three()?;
            of(4.0 / 3.0 * PI * a * b * c, [a * a / 5.0, b * b / 5.0, c * c / 5.0])
        }
        _ => return None,
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Between ends the second size says nothing.
    #[test]
    fn what_lies_between_ends_is_as_deep_as_wide() {
        for kind in ["box", "ellipsoid"] {
            let whole = volume_and_moments(kind, &[0.3, 0.3, 0.7], None);
            assert_eq!(volume_and_moments(kind, &[0.3], Some(0.7)), whole);
            assert_eq!(volume_and_moments(kind, &[0.3, 0.5], Some(0.7)), whole);
        }
        let whole = area_and_moments("box", &[0.3, 0.3, 0.7], None);
        assert_eq!(area_and_moments("box", &[0.3, 0.5], Some(0.7)), whole);
    }

    /// Summed over many thin slices along the third axis, of two half-widths each.
    #[test]
    fn volumes_as_sums_of_slices() {
        let (r, h) = (0.3, 0.7);
        type Widths = fn(f64) -> [f64; 2];
        let cases: [(&str, [f64; 3], f64, bool, Widths); 5] = [
            ("sphere", [0.3, 0.0, 0.0], r, true, |z| [(0.09 - z * z).max(0.0).sqrt(); 2]),
            ("capsule", [0.3, 0.7, 0.0], r + h, true, |z| {
                let over = (z.abs() - 0.7).max(0.0);
                [(0.09 - over * over).max(0.0).sqrt(); 2]
            }),
            ("cylinder", [0.3, 0.7, 0.0], h, true, |_| [0.3; 2]),
            ("box", [0.3, 0.5, 0.7], h, false, |_| [0.3, 0.5]),
            ("ellipsoid", [0.3, 0.5, 0.7], h, true, |z| {
                let scale = (1.0 - z * z / 0.49).max(0.0).sqrt();
                [0.3 * scale, 0.5 * scale]
            }),
        ];
        for (kind, size, top, round, widths) in cases {
            let (volume, moments) = volume_and_moments(kind, &size, None).expect("a shape");
            let slices = 20_000;
            let (mut sum, mut squares) = (0.0, [0.0; 3]);
            for k in 0..slices {
                let z = top * (2.0 * (f64::from(k) + 0.5) / f64::from(slices) - 1.0);
                let [a, b] = widths(z);
                let (area, share) = if round { (PI * a * b, 4.0) } else { (4.0 * a * b, 3.0) };
                let part = area * 2.0 * top / f64::from(slices);
                sum += part;
                squares[0] += part * a * a / share;
                squares[1] += part * b * b / share;
                squares[2] += part * z * z;
            }
            // The rule of the middle: an error of the order of the square of the width, at a round end of its power
            // 3/2.
            assert!((sum / volume - 1.0).abs() < 1e-5, "{kind}: {sum} {volume}");
            for i in 0..3 {
                let moment = (squares[(i + 1) % 3] + squares[(i + 2) % 3]) / sum;
                assert!((moment / moments[i] - 1.0).abs() < 1e-5, "{kind}: {moment} {moments:?}");
            }
        }
    }
}
