//! Laws of actuators: gains, biases and ranges of their controls.
//!
//! All elements of actuators, and of their defaults, set the same values, one after another, whatever they are called:
//! so MuJoCo's `mjXReader::OneActuator` and `mjs_setToPosition` and the like have it (3.9): `<position>` without `kp`
//! has the first gain that a class set, be it as `kv` of a `<velocity>`. Version 4 begins anew where the kinds differ.

use roxmltree::Node;

use crate::rotation::Triple;
use crate::xml::Reading;

/// Elements of actuators.
pub const ACTUATOR: &[&str] = &[
    "general",
    "motor",
    "position",
    "velocity",
    "intvelocity",
    "orientation",
    "pid",
    "damper",
    "cylinder",
    "muscle",
    "adhesion",
    "dcmotor",
    "plugin",
];

/// Parameters of an actuator.
#[derive(Clone, Debug)]
pub struct Gains<'a> {
    /// Its state, its gain and its bias by their words.
    kinds: [&'a str; 3],
    pub gear: [f64; 6],
    /// (g₀ + g₁ l + g₂ l̇) u.
    pub gain: Triple,
    /// b₀ + b₁ l + b₂ l̇.
    pub bias: Triple,
    /// Ranges of the control, and of the force, with whether they limit.
    pub ranges: [([f64; 2], Option<&'a str>); 2],
    /// The control has the range of its joint, times this.
    inherited: f64,
    pub group: f64,
}

impl<'a> Gains<'a> {
    /// MuJoCo's `mjs_defaultActuator`.
    fn usual() -> Self {
        Gains {
            kinds: ["none", "fixed", "none"],
            gear: [1.0, 0.0, 0.0, 0.0, 0.0, 0.0],
            gain: [1.0, 0.0, 0.0],
            bias: [0.0; 3],
            ranges: [([0.0; 2], None); 2],
            inherited: 0.0,
            group: 0.0,
        }
    }

    /// Gains that elements give, one after another.
    pub fn of(elements: &[Node<'a, 'a>], reading: &mut Reading<'a>) -> Self {
        let mut gains = Self::usual();
        elements.iter().for_each(|element| gains.set(*element, reading));
        gains
    }

    /// Law of the force, for a comparison.
    pub fn law(&self) -> ([&'a str; 3], [Triple; 2], f64) {
        (self.kinds, self.acting(), self.inherited())
    }

    /// Part of the range of its joint that the control of a servo has, if it has that; zero otherwise.
    pub fn inherited(&self) -> f64 {
        let [gain, bias] = self.acting();
        if gain[0] == -bias[1] { self.inherited } else { 0.0 }
    }

    /// Sets the gains that an element gives.
    fn set(&mut self, node: Node<'a, 'a>, reading: &mut Reading<'a>) {
        start_of(node, "gear", &mut self.gear, reading);
        for (range, [word, limited]) in
            self.ranges.iter_mut().zip([["ctrlrange", "ctrllimited"], ["forcerange", "forcelimited"]])
        {
            start_of(node, word, &mut range.0, reading);
            range.1 = reading.text(node, limited).or(range.1);
        }
        self.inherited = reading.number(node, "inheritrange").unwrap_or(self.inherited);
        self.group = reading.number(node, "group").unwrap_or(self.group);
        match node.tag_name().name() {
            "general" => {
                for (kind, word) in self.kinds.iter_mut().zip(["dyntype", "gaintype", "biastype"]) {
                    *kind = reading.text(node, word).unwrap_or(kind);
                }
                start_of(node, "gainprm", &mut self.gain, reading);
                start_of(node, "biasprm", &mut self.bias, reading);
            }
            "motor" => {
                self.gain[0] = 1.0;
                self.kinds = ["none", "fixed", "none"];
            }
            "position" | "intvelocity" => self.servo(node, reading),
            "velocity" => {
                let kv = reading.number(node, "kv").unwrap_or(self.gain[0]);
                (self.gain[0], self.bias) = (kv, [0.0, 0.0, -kv]);
                self.kinds = ["none", "fixed", "affine"];
            }
            "damper" => {
                let inherited = if self.kinds[1] == "affine" { -self.gain[2] } else { 0.0 };
                let kv = reading.number(node, "kv").unwrap_or(inherited);
                self.gain = [0.0, 0.0, -kv];
                self.ranges[0].1 = Some("true");
                self.kinds = ["none", "affine", "none"];
            }
            "adhesion" => {
                self.gain[0] = reading.number(node, "gain").unwrap_or(self.gain[0]);
                self.kinds = [self.kinds[0], "fixed", "none"];
            }
            tag => self.kinds = [tag; 3],
        }
    }

    /// A servo of positions, of which that of velocities integrates its control.
    fn servo(&mut self, node: Node<'a, 'a>, reading: &mut Reading<'a>) {
        let kp = reading.number(node, "kp").unwrap_or(self.gain[0]);
        (self.gain[0], self.bias[1]) = (kp, -kp);
        let [kv, ratio, time] = ["kv", "dampratio", "timeconst"].map(|word| {
            let number = reading.number(node, word);
            if number.is_some_and(|number| number < 0.0) {
                reading.fault(node, format!("`{word}` is zero or more"));
            }
            number
        });
        if kv.is_some() && ratio.is_some() {
            reading.fault(node, "`kv` and `dampratio` say the same; write one of the two");
        }
        self.bias[2] = ratio.or(kv.map(|kv| -kv)).unwrap_or(self.bias[2]);
        let state = time.map_or(self.kinds[0], |time| if time == 0.0 { "none" } else { "filterexact" });
        let state = if node.tag_name().name() == "intvelocity" { "integrator" } else { state };
        self.kinds = [state, "fixed", "affine"];
    }

    /// It has no state, and its force is a sum of its control, its length and its rate, with products of the first with
    /// the others.
    pub fn is_affine(&self) -> bool {
        let [state, gain, bias] = self.kinds;
        state == "none" && matches!(gain, "fixed" | "affine") && matches!(bias, "none" | "affine")
    }

    /// The gains, and the biases, that are in use.
    pub fn acting(&self) -> [Triple; 2] {
        let [_, gain, bias] = self.kinds;
        let gain = if gain == "fixed" { [self.gain[0], 0.0, 0.0] } else { self.gain };
        [gain, if bias == "affine" { self.bias } else { [0.0; 3] }]
    }

    /// The ratio of damping of a servo, which stands in place of a rate's bias; MuJoCo's `mj_setConst` takes a positive
    /// one for that.
    pub fn ratio(&self) -> Option<f64> {
        let [gain, bias] = self.acting();
        (gain[0] == -bias[1] && bias[2] > 0.0).then_some(bias[2])
    }
}

/// As many of some numbers as an attribute has; the others stay.
fn start_of<'a, const N: usize>(
    node: Node<'a, 'a>,
    name: &'static str,
    numbers: &mut [f64; N],
    reading: &mut Reading<'a>,
) {
    let all = reading.list(node, name).unwrap_or_default();
    numbers.iter_mut().zip(all).for_each(|(number, own)| *number = own);
}
