//! Other generators and simulators beside ours: code that `peers/install.sh` compiled, called through the same kind of
//! pointer.
//!
//! Without the feature `peers` there are none.

use std::error::Error;

use gauss_runtime::prelude::*;

use crate::measure::Way;

/// The numbers of a state, in the order in which peers read them.
pub trait Flat {
    /// Unit quaternion x y z w and position of a body, or coordinates; then speeds.
    fn numbers(&self) -> Vec<f64>;
}

impl Flat for (Isometry3<f64>, Vector6<f64>) {
    fn numbers(&self) -> Vec<f64> {
        let (pose, z) = self;
        pose.rotation.coords.iter().chain(&pose.translation.vector).chain(z).copied().collect()
    }
}

impl<const N: usize> Flat for (SVector<f64, N>, SVector<f64, N>) {
    fn numbers(&self) -> Vec<f64> {
        self.0.iter().chain(&self.1).copied().collect()
    }
}

/// What is installed.
pub struct Peers {
    #[cfg(feature = "peers")]
    installed: Vec<gauss_peers::Peer>,
}

#[cfg(not(feature = "peers"))]
impl Peers {
    /// Nothing.
    ///
    /// # Errors
    /// Never.
    pub fn load() -> Result<Self, Box<dyn Error>> {
        Ok(Self {})
    }

    /// Nothing.
    pub fn ways<S: Flat, const M: usize>(&self, _: &str, _: &[S], _: &[SVector<f64, M>]) -> Vec<(Way, f64)> {
        Vec::new()
    }

    /// Nothing.
    pub fn of_length<const N: usize, const M: usize>(
        &self,
        _: &str,
        _: &[Vec<f64>],
        _: &[SVector<f64, M>],
    ) -> Vec<(Way, f64)> {
        Vec::new()
    }
}

#[cfg(feature = "peers")]
impl Peers {
    /// All that is in the folder of the libraries; says so if there is nothing.
    ///
    /// # Errors
    /// When a library is there and cannot be loaded.
    pub fn load() -> Result<Self, Box<dyn Error>> {
        let installed = gauss_peers::all()?;
        if installed.is_empty() {
            eprintln!("There are no peers to compare with: `bash benches/peers/install.sh` installs them.");
        }
        Ok(Self { installed })
    }

    /// The ways of those that have the scene, named `PEER (COMPILER)`, with their largest difference from what is
    /// expected, relative to its length.
    pub fn ways<S: Flat, const M: usize>(
        &self,
        scene: &str,
        states: &[S],
        expected: &[SVector<f64, M>],
    ) -> Vec<(Way, f64)> {
        let flat: Vec<Vec<f64>> = states.iter().map(Flat::numbers).collect();
        match flat.first().map_or(0, Vec::len) {
            4 => self.of_length::<4, M>(scene, &flat, expected),
            6 => self.of_length::<6, M>(scene, &flat, expected),
            13 => self.of_length::<13, M>(scene, &flat, expected),
            14 => self.of_length::<14, M>(scene, &flat, expected),
            length => unreachable!("no scene has states of {length} numbers"),
        }
    }

    /// The same of functions that read `N` numbers.
    pub fn of_length<const N: usize, const M: usize>(
        &self,
        scene: &str,
        flat: &[Vec<f64>],
        expected: &[SVector<f64, M>],
    ) -> Vec<(Way, f64)> {
        let states: Vec<[f64; N]> = flat.iter().map(|numbers| std::array::from_fn(|k| numbers[k])).collect();
        let way = |peer: &gauss_peers::Peer| {
            let function = peer.function::<N, M>(scene)?;
            let differences = states.iter().zip(expected).map(|(state, expected)| {
                let difference = (SVector::from(function.call(state)) - expected).norm() / expected.norm();
                // A comparison with NaN must not pass.
                if difference.is_nan() { f64::INFINITY } else { difference }
            });
            let difference = differences.fold(0.0, f64::max);
            let name = format!("{} ({})", peer.name, peer.compiler);
            Some((Way::calling(&name, states.clone(), function, |function, state| function.call(state)), difference))
        };
        self.installed.iter().filter_map(way).collect()
    }
}

/// The peer of a way named `PEER (COMPILER)`.
pub fn peer(name: &str) -> &str {
    name.split_once(" (").map_or(name, |(peer, _)| peer)
}
