//! Surfaces of triangles from their files, and the masses that they have.
//!
//! Integrals over a volume are sums over its faces (the divergence theorem): each face makes a pyramid with one point,
//! and of a closed surface the pyramids outside of it cancel.

use std::collections::HashMap;
use std::path::Path;

use super::description::Inertial;
use super::polygon;
use super::rotation::Triple;
use super::text;

/// Bytes of a file.
const MOST: u64 = 64 << 20;

/// Triangles, each by the indices of its corners, counter-clockwise as seen from outside.
#[derive(Debug, Default, PartialEq)]
pub struct Mesh {
    pub vertices: Vec<Triple>,
    pub faces: Vec<[usize; 3]>,
    /// The volume that depends on how faces with more than four corners, in no plane, were cut.
    pub unsure: f64,
}

/// Rule that says which part of a mesh has mass, and how it is counted, as `inertia` of MuJoCo's `<mesh>` has it
/// (<https://mujoco.readthedocs.io/en/stable/XMLreference.html#asset-mesh-inertia>).
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Rule {
    /// The volume of a closed surface.
    Exact,
    /// Every pyramid counts as a positive volume: too much where the surface is not convex.
    Legacy,
    /// The surface.
    Shell,
}

impl Mesh {
    /// An STL file, binary or of text, or an OBJ file, by the end of its name.
    ///
    /// # Errors
    /// Why it cannot be read.
    pub fn read(path: &Path) -> Result<Mesh, String> {
        let end = path.extension().map(|end| end.to_string_lossy().to_ascii_lowercase()).unwrap_or_default();
        let parse = match end.as_str() {
            "stl" => stl,
            "obj" => obj,
            _ => return Err(format!("`{}` is neither an STL nor an OBJ file", path.display())),
        };
        let mesh = text::bytes(path, MOST)
            .and_then(|bytes| parse(&bytes).map_err(|why| format!("cannot read `{}`: {why}", path.display())))?;
        let finite = mesh.vertices.iter().flatten().all(|c| c.is_finite());
        let inside = mesh.faces.iter().flatten().all(|&corner| corner < mesh.vertices.len());
        if !finite || !inside {
            return Err(format!("`{}` has numbers that are not finite, or corners that are no points", path.display()));
        }
        Ok(mesh)
    }

    /// Computes mass data for density one: the mass is the volume, or the area.
    ///
    /// # Errors
    /// Why it has no such mass.
    pub fn inertial(&self, rule: Rule) -> Result<Inertial, String> {
        if rule == Rule::Exact {
            self.refuse_open()?;
        }
        // As MuJoCo's `ComputeFaceCentroid`, `ComputeVolume` and `ComputeInertia` (`src/user/user_mesh.cc`): pyramids
        // from the centroid of the surface, then from the centre of mass. Of a closed surface the points do not matter.
        let (area, middle) = self.weighed([0.0; 3], |corners| (norm(&normal(corners)) / 2.0, 3.0))?;
        let measure = |corners: &[Triple; 3]| match rule {
            Rule::Exact => (signed(corners), 4.0),
            Rule::Legacy => (signed(corners).abs(), 4.0),
            Rule::Shell => (norm(&normal(corners)) / 2.0, 3.0),
        };
        let (_, center) = if rule == Rule::Shell { (area, middle) } else { self.weighed(middle, measure)? };
        // ∫ x xᵀ over a triangle, or a pyramid from the point, is its measure times (Σ c cᵀ + Σc Σcᵀ) / (n (n + 1)), n
        // = 3, 4.
        let mut mass = 0.0;
        let mut squares = [[0.0; 3]; 3];
        for corners in self.triangles(center) {
            let (part, n) = measure(&corners);
            mass += part;
            let sum: Triple = std::array::from_fn(|i| corners.iter().map(|corner| corner[i]).sum());
            for (i, row) in squares.iter_mut().enumerate() {
                for (j, entry) in row.iter_mut().enumerate() {
                    let own: f64 = corners.iter().map(|corner| corner[i] * corner[j]).sum();
                    *entry += part / (n * (n + 1.0)) * (own + sum[i] * sum[j]);
                }
            }
        }
        let trace: f64 = (0..3).map(|i| squares[i][i]).sum();
        let entry = |i: usize, j: usize| if i == j { trace - squares[i][i] } else { -squares[i][j] };
        Ok(Inertial { mass, center, inertia: std::array::from_fn(|i| std::array::from_fn(|j| entry(i, j))) })
    }

    /// Corners from a point.
    fn triangles(&self, from: Triple) -> impl Iterator<Item = [Triple; 3]> + '_ {
        let corner = move |index: usize| std::array::from_fn(|i| self.vertices[index][i] - from[i]);
        self.faces.iter().map(move |face| face.map(corner))
    }

    /// The sum of measures, and the mean of the centres of the pyramids from a point, or of the faces; with the corners
    /// of each.
    fn weighed(&self, from: Triple, measure: impl Fn(&[Triple; 3]) -> (f64, f64)) -> Result<(f64, Triple), String> {
        let (mut all, mut sum) = (0.0, [0.0; 3]);
        for corners in self.triangles(from) {
            let (part, count) = measure(&corners);
            all += part;
            for (i, entry) in sum.iter_mut().enumerate() {
                *entry += part / count * corners.iter().map(|corner| corner[i]).sum::<f64>();
            }
        }
        if all.is_nan() || all <= 0.0 {
            return Err("its faces enclose nothing, or are seen from inside".to_owned());
        }
        Ok((all, std::array::from_fn(|i| from[i] + sum[i] / all)))
    }

    /// Every edge is there once in each direction.
    fn refuse_open(&self) -> Result<(), String> {
        let mut known: HashMap<[u64; 3], usize> = HashMap::new();
        // Adding zero makes one number of both zeros.
        let point = |index: usize| self.vertices[index].map(|c| (c + 0.0).to_bits());
        let mut number = |index: usize| {
            let next = known.len();
            *known.entry(point(index)).or_insert(next)
        };
        let mut edges: HashMap<[usize; 2], [usize; 2]> = HashMap::new();
        for face in &self.faces {
            let corners = face.map(&mut number);
            for k in 0..3 {
                let (a, b) = (corners[k], corners[(k + 1) % 3]);
                // What has shrunk to a line encloses nothing.
                if a != b {
                    edges.entry([a.min(b), a.max(b)]).or_default()[usize::from(a > b)] += 1;
                }
            }
        }
        match edges.values().all(|[there, back]| there == back) {
            true => Ok(()),
            false => Err("it is not closed, or faces are seen from inside".to_owned()),
        }
    }
}

/// Twice the area, along the normal.
fn normal([a, b, c]: &[Triple; 3]) -> Triple {
    let [u, v]: [Triple; 2] = [b, c].map(|end| std::array::from_fn(|i| end[i] - a[i]));
    std::array::from_fn(|i| u[(i + 1) % 3] * v[(i + 2) % 3] - u[(i + 2) % 3] * v[(i + 1) % 3])
}

fn norm(v: &Triple) -> f64 {
    v.iter().map(|c| c * c).sum::<f64>().sqrt()
}

/// The volume of the pyramid from the origin, negative where the face is seen from inside.
fn signed(corners: &[Triple; 3]) -> f64 {
    let normal = normal(corners);
    (0..3).map(|i| corners[0][i] * normal[i]).sum::<f64>() / 6.0
}

/// <https://www.fabbers.com/tech/STL_Format>
fn stl(bytes: &[u8]) -> Result<Mesh, String> {
    /// A header, the count of faces; of each its normal, three corners and a number.
    const HEADER: usize = 84;
    const FACE: usize = 50;
    let count = bytes.get(80..HEADER).and_then(|count| <[u8; 4]>::try_from(count).ok()).map(u32::from_le_bytes);
    let whole = |&count: &u32| bytes.len() as u64 == HEADER as u64 + FACE as u64 * u64::from(count);
    if count.filter(whole).is_none() {
        return text_of(bytes).filter(|text| text.trim_start().starts_with("solid")).map_or(
            Err("it is no STL file: its length is not that of its faces, and it is no text".to_owned()),
            ascii_stl,
        );
    }
    let number = |at: usize| {
        let word = bytes.get(at..at + 4).and_then(|word| <[u8; 4]>::try_from(word).ok());
        word.map_or(f64::NAN, |word| f64::from(f32::from_le_bytes(word)))
    };
    let corners = (HEADER..bytes.len()).step_by(FACE).flat_map(|face| (1..4).map(move |k| face + 12 * k));
    Ok(of_corners(corners.map(|at| [number(at), number(at + 4), number(at + 8)]).collect()))
}

fn ascii_stl(text: &str) -> Result<Mesh, String> {
    let mut corners = Vec::new();
    for (index, line) in text.lines().enumerate() {
        if let Some(numbers) = line.trim().strip_prefix("vertex") {
            corners.push(triple(numbers).ok_or_else(|| format!("line {} has not three numbers", index + 1))?);
        }
    }
    match corners.len() {
        0 => Err("it has no faces".to_owned()),
        count if count % 3 != 0 => Err("its faces have not three corners each".to_owned()),
        _ => Ok(of_corners(corners)),
    }
}

fn of_corners(vertices: Vec<Triple>) -> Mesh {
    let faces = (0..vertices.len() / 3).map(|k| [3 * k, 3 * k + 1, 3 * k + 2]).collect();
    Mesh { vertices, faces, unsure: 0.0 }
}

/// Points and faces of <https://www.loc.gov/preservation/digital/formats/fdd/fdd000507.shtml>; faces with more than
/// three corners are cut.
fn obj(bytes: &[u8]) -> Result<Mesh, String> {
    let text = text_of(bytes).ok_or("it is no text in UTF-8")?;
    let mut mesh = Mesh::default();
    for (index, line) in text.lines().enumerate() {
        let (word, rest) = line.trim().split_once(char::is_whitespace).unwrap_or_default();
        let wrong = |what: &str| format!("line {} has {what}", index + 1);
        match word {
            "v" => mesh.vertices.push(triple(rest).ok_or_else(|| wrong("not three numbers"))?),
            "f" => {
                let count = mesh.vertices.len();
                let corners: Option<Vec<usize>> =
                    rest.split_whitespace().map(|corner| index_of(corner, count)).collect();
                let corners = corners.filter(|corners| corners.len() >= 3);
                let corners = corners.ok_or_else(|| wrong("no face of points before it"))?;
                let cut = polygon::cut(&corners, &mesh.vertices);
                mesh.faces.extend(cut.ok_or_else(|| wrong("a face that crosses itself; write triangles"))?);
                mesh.unsure += if corners.len() > 4 { polygon::bent(&corners, &mesh.vertices) } else { 0.0 };
            }
            _ => {}
        }
    }
    Ok(mesh)
}

/// `7/1/2` is the seventh point, `-1` the last.
fn index_of(corner: &str, count: usize) -> Option<usize> {
    let number: i64 = corner.split('/').next()?.parse().ok()?;
    let index = if number < 0 { i64::try_from(count).ok()?.checked_add(number)? } else { number - 1 };
    usize::try_from(index).ok().filter(|&index| index < count)
}

fn text_of(bytes: &[u8]) -> Option<&str> {
    std::str::from_utf8(bytes).ok()
}

/// The first three numbers.
fn triple(text: &str) -> Option<Triple> {
    let numbers: Option<Vec<f64>> = text.split_whitespace().take(3).map(|word| word.parse().ok()).collect();
    <Triple>::try_from(numbers?).ok()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A box with faces of four corners, the first corner at `from`.
    fn box_file(from: Triple, sides: Triple, turned: bool) -> String {
        let corner = |k: usize| (0..3).map(move |i| from[i] + if k >> i & 1 == 1 { sides[i] } else { 0.0 });
        let points = (0..8).map(|k| format!("v {}\n", corner(k).map(|c| c.to_string()).collect::<Vec<_>>().join(" ")));
        let faces = ["1 3 4 2", "5 6 8 7", "1 2 6 5", "3 7 8 4", "1 5 7 3", "2 4 8 6"].map(|face| {
            let mut corners: Vec<&str> = face.split(' ').collect();
            if turned {
                corners.reverse();
            }
            format!("f {}/1/1 {}//1 {} {}\n", corners[0], corners[1], corners[2], corners[3])
        });
        points.chain(faces).collect()
    }

    fn near(found: &Inertial, mass: f64, center: Triple, moments: Triple) {
        // Twelve faces, some ten roundings of terms of the size of the farthest corner's each.
        let close = |a: f64, b: f64| (a - b).abs() <= 1e3 * f64::EPSILON * b.abs().max(1.0);
        assert!(close(found.mass, mass), "{found:?}");
        for i in 0..3 {
            assert!(close(found.center[i], center[i]), "{found:?}");
            assert!((0..3).all(|j| close(found.inertia[i][j], if i == j { moments[i] } else { 0.0 })), "{found:?}");
        }
    }

    fn of_squares(mass: f64, [x, y, z]: Triple) -> Triple {
        [y + z, z + x, x + y].map(|sum| mass * sum)
    }

    #[test]
    fn boxes_by_every_rule() {
        let (from, sides) = ([-1.0, 0.5, 2.0], [1.0, 2.0, 3.0]);
        let mesh = obj(box_file(from, sides, false).as_bytes()).expect("a box");
        let center = [-0.5, 1.5, 3.5];
        for rule in [Rule::Exact, Rule::Legacy] {
            near(&mesh.inertial(rule).expect("a volume"), 6.0, center, of_squares(6.0, sides.map(|a| a * a / 12.0)));
        }
        // Six faces of areas ab, at ± c/2.
        let [a, b, c] = sides;
        let areas = [b * c, c * a, a * b];
        let area: f64 = 2.0 * areas.iter().sum::<f64>();
        let mean = |i: usize| {
            sides[i] * sides[i] / area * (0..3).map(|j| if i == j { 0.5 } else { 1.0 / 6.0 } * areas[j]).sum::<f64>()
        };
        let shell = mesh.inertial(Rule::Shell).expect("an area");
        near(&shell, area, center, of_squares(area, [mean(0), mean(1), mean(2)]));
        let turned = obj(box_file(from, sides, true).as_bytes()).expect("a box");
        assert!(turned.inertial(Rule::Exact).is_err());
        assert_eq!(turned.inertial(Rule::Legacy).map(|own| own.mass), mesh.inertial(Rule::Legacy).map(|own| own.mass));
    }

    #[test]
    fn what_is_open_has_no_volume() {
        let text = box_file([0.0; 3], [1.0; 3], false);
        let open = obj(text.replace("f 1/1/1 3//1 4 2\n", "").as_bytes()).expect("five faces");
        assert!(open.inertial(Rule::Exact).unwrap_err().starts_with("it is not closed"));
        let flat = obj(b"v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\nf 3 2 1").expect("two faces");
        assert!(flat.inertial(Rule::Exact).unwrap_err().starts_with("its faces enclose nothing"));
        assert!(flat.inertial(Rule::Legacy).is_err() && flat.inertial(Rule::Shell).is_ok());
    }

    /// Text and bytes of the same four faces.
    #[test]
    fn stl_of_both_kinds() {
        let points: [Triple; 4] = [[0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
        let faces = [[0, 2, 1], [0, 1, 3], [0, 3, 2], [1, 2, 3]];
        let mut bytes = [0; 80].to_vec();
        bytes[..5].copy_from_slice(b"solid");
        bytes.extend(4_u32.to_le_bytes());
        let mut text = "solid a\n".to_owned();
        for face in faces {
            bytes.extend([0; 12]);
            text.push_str("facet normal 0 0 0\nouter loop\n");
            for [x, y, z] in face.map(|corner: usize| points[corner]) {
                bytes.extend([x, y, z].iter().flat_map(|c| (*c as f32).to_le_bytes()));
                text.push_str(&format!("vertex {x} {y} {z}\n"));
            }
            bytes.extend([0; 2]);
            text.push_str("endloop\nendfacet\n");
        }
        let binary = stl(&bytes).expect("bytes");
        assert_eq!(stl(text.as_bytes()).as_ref(), Ok(&binary));
        let own = binary.inertial(Rule::Exact).expect("a volume");
        // ∫ x² over it is 1/60, the centre at 1/4: 1/60 − 1/96 of each.
        let square = 1.0 / 60.0 - 1.0 / 96.0;
        assert!((own.mass - 1.0 / 6.0).abs() < 1e-15 && (own.inertia[0][0] - 2.0 * square).abs() < 1e-15, "{own:?}");
        for wrong in [&bytes[..bytes.len() - 1], &bytes[..83], b"solid\nvertex 0 0", b"solid\nvertex 0 0 0", b"\xff"] {
            assert!(stl(wrong).is_err(), "{wrong:?}");
        }
        for wrong in ["v 0 0", "v 0 0 0\nf 1 1 2", "v 0 0 0\nf 1 1 0", "v 0 0 0\nf -2 1 1", "v 0 0 0\nf 1 1", "v a 0 0"]
        {
            assert!(obj(wrong.as_bytes()).is_err(), "{wrong}");
        }
    }
}
