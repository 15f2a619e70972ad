use crate::algebra::Graph;
use crate::mechanics::tests::{scenes, shapes};
use crate::mechanics::{ConfigurationKind, Scene, rotation_of_quaternion};
use crate::model::{Chart, RotationChart};
use super::Kernel;
use std::collections::HashMap;

#[test]
fn dump() {
    for (motion, chart) in scenes() {
        if let Chart::Jet(RotationChart::Euler(a)) = chart { if a != [2,1,0] && a != [2,0,2] { continue } }
        for (k, shape) in shapes().into_iter().enumerate() {
            let t = std::time::Instant::now();
            let graph = Graph::new();
            let scene = Scene::new(&graph, motion, chart, shape);
            let formulas = scene.formulas();
            let mut map = HashMap::new();
            if matches!(scene.kinematics.kind, ConfigurationKind::Pose | ConfigurationKind::Rotation) {
                let q = ["x", "y", "z", "w"].map(|n| graph.symbol(n, n, false));
                for (s, e) in scene.kinematics.configuration.iter().zip(rotation_of_quaternion(&graph, q).iter().flatten()) {
                    map.insert(s.key(), e.group());
                }
            }
            let t1 = t.elapsed();
            let functions: Vec<Vec<Vec<_>>> = formulas.iter().map(|f| f.arrangements.iter().map(|o| o.iter().map(|e| e.substitute(&map)).collect()).collect()).collect();
            let kernel = match Kernel::lower(&graph, &functions) { Ok(k) => k, Err(e) => panic!("{motion:?} {chart:?} {k} {:?} {e:?}", formulas[e.function].method) };
            let line: Vec<String> = formulas.iter().zip(&kernel.functions).map(|(f, p)| { let c = p.counts(); format!("{:?}:{}+{}{}{}", f.method, c.additions, c.multiplications, if c.divisions>0 {format!("/{}", c.divisions)} else {String::new()}, if c.transcendentals>0 {format!("t{}", c.transcendentals)} else {String::new()}) }).collect();
            println!("{motion:?} {chart:?} {k}: nodes {} consts {} {:.0?}/{:.0?} | {}", graph.symbol_keys().len(), kernel.constant_symbols.len(), t1, t.elapsed(), line.join(" "));
        }
    }
}
