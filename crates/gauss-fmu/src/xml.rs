//! `modelDescription.xml` of both versions, and what describes the source code of FMI 3.0.

use std::collections::BTreeSet;
use std::fmt::Write;

use crate::Version;
use crate::units::{BASE, exponents};
use crate::variables::{Role, Variable};

/// Data of a model that its description is written of.
pub struct ModelDescription<'a> {
    pub version: Version,
    /// Name of the model, for people.
    pub name: &'a str,
    /// Name of the binary: an identifier of C.
    pub identifier: &'a str,
    pub documentation: &'a str,
    pub token: &'a str,
    pub variables: &'a [Variable],
    /// Contacts: the scene has events, and no co-simulation, which would not see them.
    pub contacts: usize,
}

impl ModelDescription<'_> {
    /// `modelDescription.xml`.
    pub fn xml(&self) -> String {
        let mut out = String::from("<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n");
        let (token, counted) = match self.version {
            Version::Two => ("guid", format!(" numberOfEventIndicators=\"{}\"", self.contacts)),
            Version::Three => ("instantiationToken", String::new()),
        };
        let name = escaped(self.name);
        let documentation = escaped(&self.documentation.split_whitespace().collect::<Vec<_>>().join(" "));
        writeln!(
            out,
            "<fmiModelDescription fmiVersion=\"{}.0\" modelName=\"{name}\" {token}=\"{}\" \
             description=\"{documentation}\" generationTool=\"Gauss {}\" variableNamingConvention=\"flat\"{counted}>",
            self.version.number(),
            self.token,
            env!("CARGO_PKG_VERSION"),
        )
        .ok();
        self.interfaces(&mut out);
        self.units(&mut out);
        writeln!(out, "  <LogCategories>\n    <Category name=\"logStatusError\"/>\n  </LogCategories>").ok();
        let tolerance = crate::TOLERANCE;
        writeln!(out, "  <DefaultExperiment startTime=\"0\" stopTime=\"1\" tolerance=\"{tolerance:e}\"/>").ok();
        out.push_str("  <ModelVariables>\n");
        self.variables.iter().enumerate().for_each(|(place, own)| self.variable(&mut out, place, own));
        out.push_str("  </ModelVariables>\n  <ModelStructure>\n");
        self.structure(&mut out);
        if self.version == Version::Three {
            self.indicators(&mut out);
        }
        out.push_str("  </ModelStructure>\n</fmiModelDescription>\n");
        out
    }

    fn interfaces(&self, out: &mut String) {
        let identifier = format!("modelIdentifier=\"{}\"", self.identifier);
        match self.version {
            Version::Two => {
                let common = "canGetAndSetFMUstate=\"true\" canSerializeFMUstate=\"true\" \
                              providesDirectionalDerivative=\"true\"";
                let files = "    <SourceFiles>\n      <File name=\"fmu.c\"/>\n    </SourceFiles>";
                let exchange = format!("completedIntegratorStepNotNeeded=\"{}\"", self.contacts == 0);
                let steps = "canHandleVariableCommunicationStepSize=\"true\"";
                let both = [("ModelExchange", &exchange[..]), ("CoSimulation", steps)];
                for (kind, own) in both.into_iter().take(self.interface_count()) {
                    writeln!(out, "  <{kind} {identifier} {own} {common}>\n{files}\n  </{kind}>").ok();
                }
            }
            Version::Three => {
                let common = "canGetAndSetFMUState=\"true\" canSerializeFMUState=\"true\" \
                              providesDirectionalDerivatives=\"true\"";
                let steps = "canHandleVariableCommunicationStepSize=\"true\"";
                let needs = self.contacts > 0;
                writeln!(out, "  <ModelExchange {identifier} {common} needsCompletedIntegratorStep=\"{needs}\"/>").ok();
                if self.interface_count() > 1 {
                    writeln!(out, "  <CoSimulation {identifier} {common} {steps}/>").ok();
                }
            }
        }
    }

    fn interface_count(&self) -> usize {
        if self.contacts == 0 { 2 } else { 1 }
    }

    fn units(&self, out: &mut String) {
        let units: BTreeSet<&str> = self.variables.iter().filter_map(|own| own.unit.as_deref()).collect();
        out.push_str("  <UnitDefinitions>\n");
        for unit in units {
            let base = exponents(unit).map(|powers| {
                let named = BASE.iter().zip(powers).filter(|(_, power)| *power != 0);
                named.map(|(name, power)| format!(" {name}=\"{power}\"")).collect::<String>()
            });
            match base {
                Some(base) => {
                    writeln!(out, "    <Unit name=\"{}\">\n      <BaseUnit{base}/>\n    </Unit>", escaped(unit)).ok()
                }
                None => writeln!(out, "    <Unit name=\"{}\"/>", escaped(unit)).ok(),
            };
        }
        out.push_str("  </UnitDefinitions>\n");
    }

    fn variable(&self, out: &mut String, place: usize, own: &Variable) {
        let kind = match own.role {
            Role::Time => "causality=\"independent\" variability=\"continuous\"",
            Role::Parameter => "causality=\"parameter\" variability=\"tunable\" initial=\"exact\"",
            Role::Input => "causality=\"input\" variability=\"continuous\"",
            Role::State => "causality=\"output\" variability=\"continuous\" initial=\"exact\"",
            Role::Rate(_) => "causality=\"local\" variability=\"continuous\" initial=\"calculated\"",
            Role::Output => "causality=\"output\" variability=\"continuous\" initial=\"calculated\"",
        };
        let mut typed = String::new();
        if let Some(unit) = &own.unit {
            write!(typed, " unit=\"{}\"", escaped(unit)).ok();
        }
        if let Role::Rate(state) = own.role {
            // FMI 2.0 counts variables from 1.
            let first = self.variables.iter().position(|own| own.role == Role::State).unwrap_or(0);
            let place = first + state + usize::from(self.version == Version::Two);
            write!(typed, " derivative=\"{place}\"").ok();
        }
        if own.role == Role::State && self.contacts > 0 {
            typed.push_str(" reinit=\"true\"");
        }
        if let Some(start) = own.start {
            write!(typed, " start=\"{start:?}\"").ok();
        }
        let described = match own.description.as_str() {
            "" => String::new(),
            text => format!(" description=\"{}\"", escaped(text)),
        };
        let named = format!("name=\"{}\" valueReference=\"{place}\"{described} {kind}", escaped(&own.name));
        match self.version {
            Version::Two => {
                writeln!(out, "    <ScalarVariable {named}>\n      <Real{typed}/>\n    </ScalarVariable>").ok()
            }
            Version::Three => writeln!(out, "    <Float64 {named}{typed}/>").ok(),
        };
    }

    fn structure(&self, out: &mut String) {
        let places = |is: &dyn Fn(Role) -> bool| -> Vec<usize> {
            let own = self.variables.iter().enumerate().filter(|(_, own)| is(own.role));
            own.map(|(place, _)| place).collect()
        };
        let lists = [
            ("Outputs", "Output", places(&|role| matches!(role, Role::State | Role::Output))),
            ("Derivatives", "ContinuousStateDerivative", places(&|role| matches!(role, Role::Rate(_)))),
            ("InitialUnknowns", "InitialUnknown", places(&|role| matches!(role, Role::Rate(_) | Role::Output))),
        ];
        for (group, single, places) in lists {
            match self.version {
                Version::Two if places.is_empty() => {}
                Version::Two => {
                    let all: String =
                        places.iter().map(|k| format!("      <Unknown index=\"{}\"/>\n", k + 1)).collect();
                    write!(out, "    <{group}>\n{all}    </{group}>\n").ok();
                }
                Version::Three => {
                    places.iter().for_each(|k| {
                        writeln!(out, "    <{single} valueReference=\"{k}\"/>").ok();
                    });
                }
            }
        }
    }

    /// Event indicators of FMI 3.0, which are the last variables.
    fn indicators(&self, out: &mut String) {
        let first = self.variables.len() - self.contacts;
        (first..self.variables.len()).for_each(|place| {
            writeln!(out, "    <EventIndicator valueReference=\"{place}\"/>").ok();
        });
    }

    /// `sources/buildDescription.xml` of FMI 3.0.
    pub fn build(&self) -> String {
        format!(
            "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<fmiBuildDescription fmiVersion=\"3.0\">\n  \
             <BuildConfiguration modelIdentifier=\"{}\">\n    <SourceFileSet language=\"C99\">\n      \
             <SourceFile name=\"fmu.c\"/>\n    </SourceFileSet>\n    <Library name=\"m\"/>\n  </BuildConfiguration>\n\
             </fmiBuildDescription>\n",
            self.identifier
        )
    }
}

/// Text of an attribute; what no XML can hold is a space.
fn escaped(text: &str) -> String {
    let mut out = String::new();
    for c in text.chars() {
        match c {
            '&' => out.push_str("&amp;"),
            '<' => out.push_str("&lt;"),
            '>' => out.push_str("&gt;"),
            '"' => out.push_str("&quot;"),
            c if c.is_control() || matches!(c, '\u{fffe}' | '\u{ffff}') => out.push(' '),
            c => out.push(c),
        }
    }
    out
}
