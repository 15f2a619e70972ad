use super::super::input::Input;
use super::super::instruction::Instruction;
use super::*;

fn input(argument: usize, component: usize) -> Operand {
    Operand::Input(Input::Component { argument, component })
}

/// Constants are argument 0.
fn place(input: Input) -> InputPlace {
    match input {
        Input::Component { argument: 0, .. } | Input::Number(_) => InputPlace::Constant,
        Input::Component { argument, component } => InputPlace::Argument { array: argument, index: component },
    }
}

/// A matrix times a vector, rows by rows.
fn product(rows: usize, columns: usize) -> Code {
    let mut code = Code::nothing();
    for row in 0..rows {
        let entry = |column| input(0, row * columns + column);
        code.instructions.push(Instruction::Multiply(entry(0), input(1, 0)));
        for column in 1..columns {
            let sum = Operand::Value(code.instructions.len() - 1);
            // Factors stand as they come.
            let factors =
                if row % 2 == 0 { (entry(column), input(1, column)) } else { (input(1, column), entry(column)) };
            code.instructions.push(Instruction::MultiplyAdd(factors.0, factors.1, sum));
        }
        code.outputs.push(Operand::Value(code.instructions.len() - 1));
    }
    code
}

#[test]
fn a_matrix_times_a_vector_is_done_column_by_column() {
    let packed = product(6, 6).packed(place, &[]).expect("packs");
    assert!(packed.steps.iter().all(|step| matches!(step, PackedStep::Pack(_))), "{:?}", packed.steps);
    assert_eq!(packed.packs.len(), 12);
    for pack in &packed.packs {
        let is_constant = |operand: &Operand| matches!(operand, Operand::Input(Input::Component { argument: 0, .. }));
        assert!(pack.operands[0].iter().all(is_constant), "{:?}", pack.operands[0]);
        assert!(pack.operands[1].iter().all(|operand| *operand == pack.operands[1][0]), "{:?}", pack.operands[1]);
    }
}

#[test]
fn what_waits_for_one_another_is_not_packed() {
    // A chain of sums with nothing beside it.
    let mut code = Code::nothing();
    code.instructions.push(Instruction::Multiply(input(0, 0), input(1, 0)));
    for k in 1..60 {
        code.instructions.push(Instruction::MultiplyAdd(input(0, k), Operand::Value(k - 1), Operand::Value(k - 1)));
    }
    code.outputs = (50..60).map(Operand::Value).collect();
    assert_eq!(code.packed(place, &[]), None);
}

#[test]
fn angles_stay_together() {
    let mut code = product(6, 6);
    let moved = |operand: Operand| operand.moved(|k| k + 2);
    let instructions = code.instructions.iter().map(|instruction| {
        instruction.map(|operand| match operand {
            Operand::Input(Input::Component { argument: 1, component }) if component < 2 => {
                if component == 0 {
                    Operand::Sine(0)
                } else {
                    Operand::Cosine(1)
                }
            }
            other => moved(other),
        })
    });
    let angles = [Instruction::SineCosine(input(1, 0)), Instruction::SineCosine(input(1, 1))];
    code.instructions = angles.into_iter().chain(instructions).collect();
    code.outputs = code.outputs.into_iter().map(moved).collect();
    let packed = code.packed(place, &[(0, 2)]).expect("packs");
    assert_eq!(packed.steps[0], PackedStep::Angles(0, 2));
}

/// Sums Σ kᵢ sin qᵢ of two limbs with constants of their own, and what both give to a base.
pub(crate) fn limbs(terms: usize, swapped: bool) -> Code {
    let mut code = Code::nothing();
    let mut sums = Vec::new();
    for limb in 0..2 {
        code.instructions.push(Instruction::SineCosine(input(1, limb)));
        let sine = Operand::Sine(code.instructions.len() - 1);
        code.instructions.push(Instruction::Multiply(sine, input(0, limb * terms)));
        for k in 1..terms {
            let last = Operand::Value(code.instructions.len() - 1);
            let constant = input(0, limb * terms + k);
            let factors = if swapped && limb == 1 { (last, constant) } else { (constant, last) };
            code.instructions.push(Instruction::MultiplyAdd(factors.0, factors.1, last));
        }
        sums.push(Operand::Value(code.instructions.len() - 1));
    }
    code.instructions.push(Instruction::Add(sums[0], sums[1]));
    code.outputs = vec![Operand::Value(code.instructions.len() - 1), sums[0], sums[1]];
    code
}

/// Relation of an input to two limbs with so many constants.
pub(crate) fn of_limb(terms: usize) -> impl Fn(Input) -> Option<Leaf> {
    move |input| {
        let Input::Component { argument, component } = input else { return None };
        let (class, limb) = if argument == 0 { (component % terms, component / terms) } else { (terms, component) };
        Some(Leaf { class: class as u64, limb, lane: limb, lanes: 2 })
    }
}

#[test]
fn what_is_alike_in_two_limbs_is_done_at_once() {
    for swapped in [false, true] {
        let code = limbs(40, swapped);
        let packed = code.with_limbs_together(of_limb(40), &[]).expect("packs");
        assert_eq!(packed.packs.len(), 40);
        assert!(packed.computes(&code));
        // Two angles and the sum of both are left.
        assert_eq!(packed.steps.len(), 43);
        for pack in &packed.packs {
            assert_eq!(pack.lanes.len(), 2);
            // Constants stand beside constants, whichever factor they are.
            let of_lane = |operand: &Operand| matches!(operand, Operand::Input(_));
            assert!(pack.operands.iter().all(|vector| of_lane(&vector[0]) == of_lane(&vector[1])), "{pack:?}");
        }
    }
}

#[test]
fn limbs_that_differ_are_left_as_they_are() {
    let terms = 40;
    // The constants of the second limb come in another order.
    let other = |input| match input {
        Input::Component { argument: 0, component } if component >= terms => {
            let leaf = of_limb(terms)(input)?;
            Some(Leaf { class: (terms - 1) as u64 - leaf.class, ..leaf })
        }
        _ => of_limb(terms)(input),
    };
    assert_eq!(limbs(terms, false).with_limbs_together(other, &[]), None);
    assert_eq!(limbs(terms, false).with_limbs_together(|_| None, &[]), None);
}
