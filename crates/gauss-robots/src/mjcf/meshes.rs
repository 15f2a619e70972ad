//! Masses of `<geom type="mesh">`: of the file, or the points, of its `<mesh>`.

use std::path::{Path, PathBuf};

use roxmltree::Node;

use super::File;
use crate::description::Inertial;
use crate::hull::hull;
use crate::mesh::{Mesh, Rule};
use crate::names::unknown;
use crate::rotation::{Rotation, Triple, of_quaternion};
use crate::xml::shown;

const MESH: &[&str] = &["mesh"];

impl<'a> File<'a> {
    /// Mass data of a mesh for density one, in the axes of the geom; `None` where it is wrong, which is noted.
    pub fn of_mesh(&mut self, geom: Node<'a, 'a>, kind: &str, name: &str) -> Option<Inertial> {
        if kind != "mesh" {
            self.reading.fault(
                geom,
                format!("its mass is that of a `{kind}` fitted to a mesh, which is not read; write an <inertial>"),
            );
            return None;
        }
        let assets = self.reading.children(geom.document().root_element(), "asset");
        let all: Vec<Node<'a, 'a>> =
            assets.into_iter().flat_map(|asset| self.reading.children(asset, "mesh")).collect();
        let Some(node) = all.iter().find(|node| called(**node).as_deref() == Some(name)) else {
            let names: Vec<String> = all.iter().filter_map(|node| called(*node)).collect();
            let which = unknown("mesh", name, names.iter().map(String::as_str));
            self.reading.fault(geom, format!("it is {which}"));
            return None;
        };
        if let Some((_, known)) = self.meshes.iter().find(|(known, _)| known == name) {
            return *known;
        }
        let read = self.solid(*node);
        self.meshes.push((name.to_owned(), read));
        read
    }

    fn solid(&mut self, node: Node<'a, 'a>) -> Option<Inertial> {
        // In earlier versions of MuJoCo an attribute of `<compiler>` chooses this for all meshes.
        let compilers = self.reading.children(node.document().root_element(), "compiler");
        let is_exact = |node: &Node<'a, 'a>| self.reading.text(*node, "exactmeshinertia") == Some("true");
        let usual = if compilers.iter().any(is_exact) { "exact" } else { "legacy" };
        let word = self.text(node, MESH, "inertia", None).unwrap_or(usual);
        let rule = match word {
            "exact" | "convex" => Rule::Exact,
            "legacy" => Rule::Legacy,
            "shell" => Rule::Shell,
            _ => {
                self.reading.fault(node, format!("`inertia` is convex, exact, legacy or shell, found `{word}`"));
                return None;
            }
        };
        let mut mesh = self.surface(node)?;
        // Points without faces stand for their hull.
        if word == "convex" || mesh.faces.is_empty() {
            let most = self.numbers(node, MESH, "maxhullvert", None).filter(|[most]| *most > 0.0);
            mesh.faces = hull(&mesh.vertices).filter(|_| most.is_none()).unwrap_or_default();
            mesh.unsure = 0.0;
            if mesh.faces.is_empty() {
                self.reading.fault(node, "its convex hull is not made: it is flat, or has `maxhullvert`");
                return None;
            }
        }
        match mesh.inertial(rule) {
            Ok(own) => {
                let volume = if rule == Rule::Legacy {
                    mesh.inertial(Rule::Exact).map_or(own.mass, |own| own.mass)
                } else {
                    own.mass
                };
                let more = 100.0 * (own.mass / volume - 1.0);
                if more > 0.01 {
                    let text = format!(
                        "{} weighs {more:.2} % more than its volume, by `inertia=\"legacy\"`; write `exact`",
                        shown(node)
                    );
                    self.reading.note(node, text);
                }
                let unsure = if rule == Rule::Shell { 0.0 } else { 100.0 * mesh.unsure / volume };
                if unsure > 0.01 {
                    let text = format!(
                        "what {} weighs is known to {unsure:.2} %: it has faces of more than four corners in no plane, \
                         which can be cut in several ways; write triangles",
                        shown(node)
                    );
                    self.reading.note(node, text);
                }
                Some(own)
            }
            Err(why) => {
                self.reading.fault(node, format!("its mass is not known: {why}"));
                None
            }
        }
    }

    /// As it is in the axes of the geom: from its reference, turned, then scaled.
    fn surface(&mut self, node: Node<'a, 'a>) -> Option<Mesh> {
        let mut mesh = match self.reading.text(node, "file") {
            Some(file) => {
                let path = self.path_of_mesh(node, file);
                match Mesh::read(&path) {
                    Ok(mesh) => {
                        self.description.files.push(path);
                        mesh
                    }
                    Err(why) => {
                        self.reading.fault(node, why);
                        return None;
                    }
                }
            }
            None => self.points(node)?,
        };
        let reference: Triple = self.reading.numbers(node, "refpos").unwrap_or_default();
        let turn = self.reading.numbers(node, "refquat").and_then(of_quaternion).unwrap_or(Rotation::none().matrix);
        let scale: Triple = self.numbers(node, MESH, "scale", None).unwrap_or([1.0; 3]);
        for point in &mut mesh.vertices {
            let from: Triple = std::array::from_fn(|i| point[i] - reference[i]);
            *point = std::array::from_fn(|i| scale[i] * (0..3).map(|k| turn[k][i] * from[k]).sum::<f64>());
        }
        mesh.unsure *= scale.iter().product::<f64>().abs();
        if scale.iter().product::<f64>() < 0.0 {
            mesh.faces.iter_mut().for_each(|face| face.swap(1, 2));
        }
        Some(mesh)
    }

    /// Mesh that is written in the element itself.
    fn points(&mut self, node: Node<'a, 'a>) -> Option<Mesh> {
        let (points, corners) = (self.reading.list(node, "vertex"), self.reading.list(node, "face"));
        let Some(points) = points else {
            self.reading.fault(node, "its mass needs `file` or `vertex`");
            return None;
        };
        let corners = corners.unwrap_or_default();
        let whole = |number: &f64| *number >= 0.0 && number.fract() == 0.0 && *number < (points.len() / 3) as f64;
        if points.len() % 3 != 0 || corners.len() % 3 != 0 || !corners.iter().all(whole) {
            self.reading
                .fault(node, "`vertex` is three numbers a point, `face` three points, counted from zero, a face");
            return None;
        }
        let vertices = points.chunks_exact(3).map(|point| [point[0], point[1], point[2]]).collect();
        let faces =
            corners.chunks_exact(3).map(|face| [face[0], face[1], face[2]].map(|corner| corner as usize)).collect();
        Some(Mesh { vertices, faces, unsure: 0.0 })
    }

    /// Path of a mesh by `meshdir`, or `assetdir`, from the folder of the first file.
    fn path_of_mesh(&mut self, node: Node<'a, 'a>, file: &str) -> PathBuf {
        let (mut folder, mut strip) = ([None; 2], false);
        for compiler in self.reading.children(node.document().root_element(), "compiler") {
            let own = ["meshdir", "assetdir"].map(|word| self.reading.text(compiler, word));
            folder = [own[0].or(folder[0]), own[1].or(folder[1])];
            strip |= self.reading.text(compiler, "strippath") == Some("true");
        }
        let file = Path::new(file);
        let file = if strip { file.file_name().map_or(file, Path::new) } else { file };
        self.reading.folder().join(folder[0].or(folder[1]).unwrap_or_default()).join(file)
    }
}

/// Name of a mesh, or else that of its file.
fn called(mesh: Node<'_, '_>) -> Option<String> {
    let of_file = || Some(Path::new(mesh.attribute("file")?.trim()).file_stem()?.to_string_lossy().into_owned());
    mesh.attribute("name").map(|name| name.trim().to_owned()).or_else(of_file)
}

#[cfg(test)]
mod tests {
    use crate::description::{Description, Fault};
    use crate::mjcf::read;
    use crate::text::{Text, Written};

    /// A prism over an L, which is not convex.
    const PRISM: &str = "v 0 0 0\nv 2 0 0\nv 2 1 0\nv 1 1 0\nv 1 3 0\nv 0 3 0\nv 0 0 0.5\nv 2 0 0.5\nv 2 1 0.5\nv 1 1 0.5\n\
                         v 1 3 0.5\nv 0 3 0.5\nf 1 3 2\nf 7 8 9\nf 1 4 3\nf 7 9 10\nf 1 5 4\nf 7 10 11\nf 1 6 5\nf 7 11 12\n\
                         f 1 2 8\nf 1 8 7\nf 2 3 9\nf 2 9 8\nf 3 4 10\nf 3 10 9\nf 4 5 11\nf 4 11 10\nf 5 6 12\nf 5 12 11\n\
                         f 6 1 7\nf 6 7 12\n";

    const GEOM: &str = "<geom type=\"mesh\" mesh=\"prism\" pos=\"1 2 3\" euler=\"10 20 30\" density=\"100\"/>";

    /// Describes a file in a folder with the prism.
    fn described(compiler: &str, mesh: &str, geom: &str) -> Result<Description, Vec<Fault>> {
        described_beside(PRISM, compiler, mesh, geom)
    }

    /// The description by a file in a folder with a mesh.
    fn described_beside(solid: &str, compiler: &str, mesh: &str, geom: &str) -> Result<Description, Vec<Fault>> {
        let folder = std::env::temp_dir().join(format!("gauss-meshes-{}-{:p}", std::process::id(), mesh));
        std::fs::create_dir_all(folder.join("parts")).expect("a folder for files that do not stay");
        for name in ["prism.obj", "parts/prism.OBJ"] {
            std::fs::write(folder.join(name), solid).expect("a folder that can be written");
        }
        let text = format!(
            "<mujoco>{compiler}<asset><mesh {mesh}/></asset><worldbody><body name=\"b\"><joint/>{geom}</body></worldbody></mujoco>"
        );
        let read = read(&Text::of(Written::new("main.xml".to_owned(), folder.join("main.xml"), text)));
        // What is left behind harms nobody.
        let _ = std::fs::remove_dir_all(&folder);
        read
    }

    /// Masses, places and inertias are those of MuJoCo 4.0.0 (`body_mass`, `body_ipos`, and `body_inertia` turned by
    /// `body_iquat`) of the same files.
    #[test]
    fn masses_by_every_rule() {
        let turned = "refpos=\"0.5 0 0\" refquat=\"1 1 0 0\" scale=\"1 -2 0.5\"";
        #[rustfmt::skip]
        let cases = [
            ("exact", "", 200.0, [1.1085454088522546, 3.3960508098769866, 3.476193270068894],
             [113.42967886724645, 125.47874593977961, 186.0915751929762, 51.425100497192, 44.142605704971515, -33.61544817869829]),
            ("exact", turned, 200.0, [1.2246099859552775, 1.8263580077769153, 2.2109982175267486],
             [54.87687446309146, 84.36268228521288, 79.51044325169681, -16.373415689301712, -13.478279394052493, -2.581824665579568]),
            ("legacy", "", 208.07181060248544, [1.1320581508106993, 3.402841934889218, 3.4687007704479225],
             [114.10730919980932, 128.63237998433803, 189.19956064466777, 50.55403404256289, 44.983602419373824, -33.331441770332034]),
            ("legacy", turned, 208.09831895598302, [1.2430285547040691, 1.8372856579186216, 2.2099271576198722],
             [56.048857881150845, 86.81038280714621, 83.00013564140173, -17.59752873449281, -13.232354022525477, -2.5730998736289687]),
            ("convex", "", 250.0, [1.1643346124769354, 3.5280963385537163, 3.4788576031866576],
             [139.26481243000106, 137.63757453561553, 219.06983525660826, 48.335578099697706, 46.77971224312548, -36.403162208276434]),
            ("convex", turned, 250.0, [1.305302209474135, 1.8966047873651253, 2.148537211744818],
             [69.57754792304046, 101.02511234277742, 98.28622862307212, -21.578515988232052, -9.178781075183254, 0.6959550979010136]),
            ("shell", "", 1300.0, [1.1151598582937243, 3.422339484629445, 3.4783840710091694],
             [917.820258562117, 1004.6794977619247, 1471.4105000862364, 362.99163139173953, 329.6327298554334, -245.57006784006995]),
            ("shell", turned, 1100.0, [1.2839827840396176, 1.8615836094101812, 2.207545624415171],
             [457.58134317394735, 662.9670304242892, 644.981929432075, -119.56046960962259, -84.56751679870587, -17.499902999345817]),
        ];
        for (rule, more, mass, center, [xx, yy, zz, xy, xz, yz]) in cases {
            let mesh = format!("file=\"prism.obj\" inertia=\"{rule}\" {more}");
            let own = described("", &mesh, GEOM).expect("a mesh").links[1].inertial.expect("a mass");
            // MuJoCo turns to principal axes and back: some hundred roundings, of the largest entry.
            let near = |a: f64, b: f64, size: f64| (a - b).abs() < 1e-12 * size;
            assert!(near(own.mass, mass, mass), "{rule} {more}: {own:?}");
            let expected = [[xx, xy, xz], [xy, yy, yz], [xz, yz, zz]];
            for i in 0..3 {
                assert!(near(own.center[i], center[i], 4.0), "{rule} {more}: {own:?}");
                assert!(
                    (0..3).all(|j| near(own.inertia[i][j], expected[i][j], xx + yy + zz)),
                    "{rule} {more}: {own:?}"
                );
            }
        }
    }

    /// Points, and faces of which those with the most corners begin at the one of that number.
    fn solid(points: &[[f64; 3]], faces: &[&[usize]], first: usize) -> String {
        let points = points.iter().map(|[x, y, z]| format!("v {x} {y} {z}\n"));
        let most = faces.iter().map(|face| face.len()).max().unwrap_or(0);
        let faces = faces.iter().map(|face| {
            let from = if face.len() == most { first } else { 0 };
            let corners = (0..face.len()).map(|k| (face[(k + from) % face.len()] + 1).to_string());
            format!("f {}\n", corners.collect::<Vec<_>>().join(" "))
        });
        points.chain(faces).collect()
    }

    /// A cube with one corner lifted by a half, and a prism over an L, by every rule: `body_mass` of MuJoCo 4.0.0 of
    /// the same files, whichever corner comes first. Where the L is elsewhere MuJoCo takes some corners for ears which
    /// are none, and drops others (it asks on which side of the origin they are; 12,745.9 for 14,000 there); the volume
    /// is what it was.
    #[test]
    fn faces_with_several_corners() {
        let cube: Vec<[f64; 3]> = (0..8)
            .map(|k: usize| {
                let [x, y, z] = [0, 1, 2].map(|i| (k >> i & 1) as f64);
                [x, y, if k == 7 { 1.5 } else { z }]
            })
            .collect();
        let sides: [&[usize]; 6] =
            [&[0, 2, 3, 1], &[4, 5, 7, 6], &[0, 1, 5, 4], &[2, 6, 7, 3], &[0, 4, 6, 2], &[1, 3, 7, 5]];
        let prism = |x: f64, y: f64| -> Vec<[f64; 3]> {
            let corners = [[0.0, 0.0], [4.0, 0.0], [4.0, 1.0], [1.0, 1.0], [1.0, 11.0], [0.0, 11.0]];
            [0.0, 1.0].into_iter().flat_map(|z| corners.map(|[a, b]| [a + x, b + y, z])).collect()
        };
        #[rustfmt::skip]
        let walls: [&[usize]; 8] = [&[5, 4, 3, 2, 1, 0], &[6, 7, 8, 9, 10, 11], &[0, 1, 7, 6], &[1, 2, 8, 7],
            &[2, 3, 9, 8], &[3, 4, 10, 9], &[4, 5, 11, 10], &[5, 0, 6, 11]];
        let geom = "<geom type=\"mesh\" mesh=\"prism\"/>";
        let rules = ["exact", "legacy", "shell", "convex"];
        let check = |points: &[[f64; 3]], faces: &[&[usize]], masses: [f64; 4]| {
            for (rule, expected) in rules.into_iter().zip(masses) {
                for first in 0..6 {
                    let mesh = format!("file=\"prism.obj\" inertia=\"{rule}\"");
                    let read = described_beside(&solid(points, faces, first), "", &mesh, geom).expect("a mesh");
                    let mass = read.links[1].inertial.expect("a mass").mass;
                    // Some ten faces, some ten roundings each.
                    assert!((mass / expected - 1.0).abs() < 1e-13, "{rule}, from {first}: {mass}");
                    assert!(!read.notes.iter().any(|note| note.text.contains("is known to")), "{:?}", read.notes);
                }
            }
        };
        let lifted = [1083.3333333333333, 1083.3333333333333, 6612.372435695795, 1166.6666666666665];
        check(&cube, &sides, lifted);
        check(&prism(0.0, 0.0), &walls, [14000.0, 21306.259349732052, 58000.0, 29000.0]);
        check(&prism(3.0, -7.0), &walls, [14000.0, 21306.259349732052, 58000.0, 29000.0]);
    }

    /// A file does not say what is below a face that is in no plane.
    #[test]
    fn faces_in_no_plane() {
        let corners = [[1.0, 0.0], [0.3, 1.0], [-0.8, 0.6], [-0.8, -0.6], [0.3, -1.0]];
        let points: Vec<[f64; 3]> = corners
            .iter()
            .enumerate()
            .map(|(k, [x, y])| [*x, *y, if k == 2 { 0.1 } else { 0.0 }])
            .chain([[0.0, 0.0, -1.0]])
            .collect();
        let faces: [&[usize]; 6] = [&[0, 1, 2, 3, 4], &[1, 0, 5], &[2, 1, 5], &[3, 2, 5], &[4, 3, 5], &[0, 4, 5]];
        let geom = "<geom type=\"mesh\" mesh=\"prism\"/>";
        let mesh = "file=\"prism.obj\" inertia=\"exact\"";
        let of = |points: &[[f64; 3]], first: usize| {
            let read = described_beside(&solid(points, &faces, first), "", mesh, geom).expect("a mesh");
            let told = read.notes.iter().find(|note| note.text.contains("is known to"));
            (read.links[1].inertial.expect("a mass").mass, told.map(|note| note.text.clone()))
        };
        let (masses, texts): (Vec<f64>, Vec<Option<String>>) = (0..5).map(|first| of(&points, first)).unzip();
        let text = texts[0].as_ref().expect("a remark");
        let said: f64 = text.split("known to ").nth(1).unwrap().split(" %").next().unwrap().parse().unwrap();
        let [least, most] = masses.iter().fold([f64::MAX, 0.0], |[a, b]: [f64; 2], m| [a.min(*m), b.max(*m)]);
        assert!(most / least - 1.0 > 0.01 && most / least - 1.0 < said / 100.0, "{masses:?}: {text}");
        let flat: Vec<[f64; 3]> = points.iter().map(|[x, y, z]| [*x, *y, z.min(0.0)]).collect();
        assert_eq!(of(&flat, 0).1, None);
        let bow = [[4.0, 4.0, 0.0], [1.0, 3.0, 0.0], [0.0, 3.0, 0.0], [2.0, 4.0, 0.0], [4.0, 1.0, 0.0]];
        let bow = solid(&bow, &[&[0, 1, 2, 3, 4]], 0);
        let faults = described_beside(&bow, "", mesh, geom).map(|_| ()).expect_err("a bow");
        assert!(faults[0].message.contains("line 6 has a face that crosses itself; write triangles"), "{faults:?}");
    }

    #[test]
    fn where_files_are() {
        let exact = |mesh: &str| format!("name=\"prism\" inertia=\"exact\" {mesh}");
        let found = |compiler: &str, file: &str| {
            let read = described(compiler, &exact(&format!("file=\"{file}\"")), GEOM).expect("a mesh");
            let inside = read.files[0].ends_with("parts/prism.OBJ");
            (read.files.len(), inside, read.links[1].inertial.map(|own| own.mass.round()))
        };
        assert_eq!(found("", "prism.obj"), (1, false, Some(200.0)));
        assert_eq!(found("", "parts/prism.OBJ"), (1, true, Some(200.0)));
        assert_eq!(found("<compiler meshdir=\"parts/\" assetdir=\"no\"/>", "prism.OBJ"), (1, true, Some(200.0)));
        assert_eq!(found("<compiler assetdir=\"parts\" strippath=\"true\"/>", "a/b/prism.OBJ"), (1, true, Some(200.0)));
        let points = "vertex=\"0 0 0 1 0 0 0 1 0 0 0 1\" face=\"0 2 1 0 1 3 0 3 2 1 2 3\"";
        let read = described("", &exact(points), &GEOM.replace("density=\"100\"", "mass=\"7\"")).expect("points");
        assert_eq!((read.files.len(), read.links[1].inertial.map(|own| own.mass)), (0, Some(7.0)));
    }

    #[test]
    fn what_is_refused() {
        let message = |mesh: &str, geom: &str| described("", mesh, geom).expect_err(mesh)[0].message.clone();
        for (mesh, expected) in [
            ("file=\"prism.obj\" inertia=\"convex\" scale=\"0 1 1\"", "its convex hull is not made: it is flat"),
            ("file=\"prism.obj\" inertia=\"convex\" maxhullvert=\"8\"", "its convex hull is not made"),
            ("file=\"prism.obj\" inertia=\"solid\"", "`inertia` is convex, exact, legacy or shell, found `solid`"),
            ("name=\"prism\" file=\"nowhere.stl\"", "cannot read `"),
            ("name=\"prism\" file=\"prism.msh\"", "is neither an STL nor an OBJ file"),
            ("name=\"prism\" builtin=\"sphere\"", "its mass needs `file` or `vertex`"),
            ("name=\"prism\" vertex=\"0 0 0\" face=\"0 0 1\"", "`vertex` is three numbers a point"),
            ("file=\"prism.obj\" inertia=\"exact\" scale=\"0 1 1\"", "its faces enclose nothing"),
            ("name=\"prsm\" file=\"prism.obj\"", "which is no mesh; did you mean `prsm`?"),
        ] {
            assert!(message(mesh, GEOM).contains(expected), "{}", message(mesh, GEOM));
        }
        let fitted = message("file=\"prism.obj\"", &GEOM.replace("type=\"mesh\"", "type=\"box\""));
        assert!(fitted.contains("a `box` fitted to a mesh, which is not read"), "{fitted}");
        let legacy = described("", "file=\"prism.obj\"", GEOM).expect("a mesh");
        assert!(legacy.notes[0].text.contains("weighs 4.04 % more than its volume"), "{:?}", legacy.notes);
    }
}
