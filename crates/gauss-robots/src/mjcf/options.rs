//! Gravity and other forces on every body, and what is switched off.

use roxmltree::Node;

use super::File;
use super::disabled::Disabled;
use crate::description::Nonlinear;
use crate::xml::shown;

impl<'a> File<'a> {
    /// Reads gravity in observer's axes, m/s² (that of the earth where the file gives none), and the options that
    /// switch forces off. The options of a file that attaches this one act on both, as in MuJoCo.
    pub fn options(&mut self, root: Node<'a, 'a>, around: Option<&File<'_>>) {
        let mut gravity = [0.0, 0.0, -9.81];
        let mut is_off = false;
        let mut disabled = Disabled::default();
        let all = self.reading.children(root, "option");
        for &option in &all {
            gravity = self.reading.numbers(option, "gravity").unwrap_or(gravity);
            disabled.groups = self.reading.list(option, "actuatorgroupdisable").unwrap_or_default();
            for flag in self.reading.children(option, "flag") {
                let off = |word: &'static str| self.reading.text(flag, word) == Some("disable");
                is_off |= off("gravity");
                // `passive` is what `spring` and `damper` were called together.
                let Disabled {
                    actuation,
                    clamps,
                    springs,
                    dampers,
                    equalities,
                    frictions,
                    limits,
                    contacts,
                    parents_touch,
                    ..
                } = &mut disabled;
                *actuation |= off("actuation");
                *clamps |= off("clampctrl");
                *springs |= off("spring") || off("passive");
                *dampers |= off("damper") || off("passive");
                *equalities |= off("equality") || off("constraint");
                *frictions |= off("frictionloss") || off("constraint");
                *limits |= off("limit") || off("constraint");
                *contacts |= off("contact") || off("constraint");
                *parents_touch |= off("filterparent");
            }
        }
        let is_said = is_off || disabled != Disabled::default() || all.iter().any(|node| node.has_attribute("gravity"));
        (self.description.gravity, self.disabled) = (Some(if is_off { [0.0; 3] } else { gravity }), disabled);
        let Some(around) = around else { return };
        let is_same = (self.description.gravity, &self.disabled) == (around.description.gravity, &around.disabled);
        if let (true, Some(option)) = (is_said && !is_same, all.first()) {
            let text = "those of the file that attaches this one act: gravity and what is switched off are others here";
            self.reading.ignored(*option, format!("{} does not act: {text}", shown(*option)));
        }
        self.description.gravity = around.description.gravity;
        self.disabled = around.disabled.clone();
    }

    /// Takes away what is switched off, once all is read.
    pub fn switch_off(&mut self) {
        let Disabled { springs, dampers, equalities, frictions, limits, .. } = self.disabled;
        let left = |Nonlinear { stiffness, damping }: Nonlinear| Nonlinear {
            stiffness: if springs { [0.0; 2] } else { stiffness },
            damping: if dampers { [0.0; 2] } else { damping },
        };
        let description = &mut self.description;
        description.parents_touch = self.disabled.parents_touch;
        for joint in &mut description.joints {
            joint.stiffness *= f64::from(!springs);
            joint.damping *= f64::from(!dampers);
            joint.nonlinear = left(joint.nonlinear);
            joint.friction *= f64::from(!frictions);
            joint.limits = if limits { [None; 2] } else { joint.limits };
            joint.mimic = joint.mimic.take().filter(|_| !equalities);
        }
        for tendon in &mut description.tendons {
            tendon.stiffness *= f64::from(!springs);
            tendon.damping *= f64::from(!dampers);
            tendon.nonlinear = left(tendon.nonlinear);
            tendon.limits = tendon.limits.filter(|_| !limits);
        }
        for cable in &mut description.cables {
            cable.stiffness *= f64::from(!springs);
            cable.damping *= f64::from(!dampers);
            cable.nonlinear = left(cable.nonlinear);
            cable.limits = cable.limits.filter(|_| !limits);
        }
        if equalities {
            description.closures.clear();
            description.polynomials.clear();
        }
    }
}
