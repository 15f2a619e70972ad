//! Instructions of x86-64 for vectors of four or eight numbers, as bytes.
//!
//! Encodings are those of the manual of the architecture (Intel SDM, volume 2): VEX of AVX2 and FMA for four numbers,
//! EVEX of AVX-512F for eight. Places in memory always have a displacement of 32 bits, which neither scales.

/// Numbers that fill a vector.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Width {
    Four,
    Eight,
}

impl Width {
    pub fn count(self) -> usize {
        match self {
            Self::Four => 4,
            Self::Eight => 8,
        }
    }

    /// Registers of vectors.
    pub fn registers(self) -> u8 {
        match self {
            Self::Four => 16,
            Self::Eight => 32,
        }
    }
}

/// A list of numbers in memory, by the register that its address is in: all are kept over calls.
#[derive(Clone, Copy, Debug)]
pub enum Base {
    Inputs = 3,     // rbx
    Outputs = 5,    // rbp
    Room = 13,      // r13
    Constants = 14, // r14
    Numbers = 15,   // r15
}

/// A place in memory: a vector, or one number for all places of one.
#[derive(Clone, Copy, Debug)]
pub struct Location {
    pub base: Base,
    /// Distance from the base in bytes.
    pub offset: i32,
    pub is_single: bool,
}

/// The last operand of an instruction.
#[derive(Clone, Copy, Debug)]
pub enum Source {
    Register(u8),
    Memory(Location),
}

/// An instruction: its map of opcodes (1: `0F`, 2: `0F 38`), its opcode, and whether VEX says W.
#[derive(Clone, Copy, Debug)]
pub struct Opcode(u8, u8, bool);

impl Opcode {
    pub const LOAD: Self = Self(1, 0x10, false);
    const STORE: Self = Self(1, 0x11, false);
    pub const MOVE: Self = Self(1, 0x28, false);
    const REPEAT: Self = Self(2, 0x19, false);
    pub const ADD: Self = Self(1, 0x58, false);
    pub const MULTIPLY: Self = Self(1, 0x59, false);
    pub const SUBTRACT: Self = Self(1, 0x5c, false);
    pub const DIVIDE: Self = Self(1, 0x5e, false);
    pub const ROOT: Self = Self(1, 0x51, false);
    pub const AND: Self = Self(1, 0xdb, false);
    pub const OR: Self = Self(1, 0xeb, false);
    pub const XOR: Self = Self(1, 0xef, false);
    pub const SUBTRACT_BITS: Self = Self(1, 0xfb, false);
    const SHIFT: Self = Self(1, 0x73, false);

    /// ± a·b + c by the place of the operand that the result replaces: a (then c is read last, or b), or c.
    pub fn fused(is_negative: bool, order: Order) -> Self {
        let positive = match order {
            Order::FactorThenFactor => 0x98,
            Order::FactorThenTerm => 0xa8,
            Order::Term => 0xb8,
        };
        Self(2, positive + if is_negative { 4 } else { 0 }, true)
    }
}

/// The operand of a fused product that its result replaces, and the one that may be in memory.
#[derive(Clone, Copy, Debug)]
pub enum Order {
    /// Replaces a factor, reads the other one last (132).
    FactorThenFactor,
    /// Replaces a factor, reads the term last (213).
    FactorThenTerm,
    /// Replaces the term (231).
    Term,
}

#[derive(Debug)]
pub struct Assembler {
    pub bytes: Vec<u8>,
    pub width: Width,
}

impl Assembler {
    /// A function of five addresses, which it keeps in the registers of [`Base`].
    pub fn new(width: Width) -> Self {
        let mut bytes = vec![0x53, 0x55, 0x41, 0x55, 0x41, 0x56, 0x41, 0x57]; // push rbx, rbp, r13, r14, r15
        bytes.extend([0x48, 0x89, 0xfb, 0x48, 0x89, 0xf5]); // mov rbx, rdi; mov rbp, rsi
        bytes.extend([0x49, 0x89, 0xd5, 0x49, 0x89, 0xce, 0x4d, 0x89, 0xc7]); // mov r13, rdx; mov r14, rcx; mov r15, r8
        Self { bytes, width }
    }

    /// The end of the function.
    pub fn finish(mut self) -> Vec<u8> {
        self.forget_upper();
        self.bytes.extend([0x41, 0x5f, 0x41, 0x5e, 0x41, 0x5d, 0x5d, 0x5b, 0xc3]); // pop r15, r14, r13, rbp, rbx; ret
        self.bytes
    }

    /// Upper halves of vectors are zero when other code runs, which waits for them otherwise.
    fn forget_upper(&mut self) {
        self.bytes.extend([0xc5, 0xf8, 0x77]); // vzeroupper
    }

    /// `target = first · source`, whatever the operation is; of operations of one operand `first` is 0.
    pub fn vector(&mut self, opcode: Opcode, target: u8, first: u8, source: Source) {
        let is_repeated = matches!(source, Source::Memory(Location { is_single: true, .. }));
        self.prefix(opcode, [target, first], source, is_repeated && self.width == Width::Eight);
        self.place(target, source);
    }

    /// Loads a register.
    pub fn load(&mut self, target: u8, memory: Location) {
        if memory.is_single {
            self.prefix(Opcode::REPEAT, [target, 0], Source::Memory(memory), false);
            self.place(target, Source::Memory(memory));
        } else {
            self.vector(Opcode::LOAD, target, 0, Source::Memory(memory));
        }
    }

    /// Stores a register.
    pub fn store(&mut self, register: u8, memory: Location) {
        self.vector(Opcode::STORE, register, 0, Source::Memory(memory));
    }

    /// Shifts the bits of each number, to the left or to the right.
    pub fn shift(&mut self, is_left: bool, count: u8, target: u8, register: u8) {
        let extension = if is_left { 6 } else { 2 };
        self.prefix(Opcode::SHIFT, [extension, target], Source::Register(register), false);
        self.place(extension, Source::Register(register));
        self.bytes.push(count);
    }

    /// Calls a function with the address of the room and three numbers.
    pub fn call(&mut self, function: u64, numbers: [u64; 3]) {
        self.forget_upper();
        self.bytes.extend([0x4c, 0x89, 0xef]); // mov rdi, r13
        for (code, number) in [0xbe, 0xba, 0xb9].into_iter().zip(numbers) {
            self.bytes.extend([0x48, code]); // mov rsi, rdx, rcx
            self.bytes.extend(number.to_le_bytes());
        }
        self.bytes.extend([0x48, 0xb8]); // mov rax
        self.bytes.extend(function.to_le_bytes());
        self.bytes.extend([0xff, 0xd0]); // call rax
    }

    fn prefix(&mut self, opcode: Opcode, [register, first]: [u8; 2], source: Source, is_repeated: bool) {
        let Opcode(map, code, has_w) = opcode;
        // Bits of registers are inverted; the fifth of a last register is where an index has its fourth.
        let (fourth, fifth) = match source {
            Source::Register(last) => (last >> 3 & 1, last >> 4 & 1),
            Source::Memory(memory) => (memory.base as u8 >> 3 & 1, 0),
        };
        let inverted = |bit: u8, place: u8| (bit & 1 ^ 1) << place;
        let names = inverted(register >> 3, 7) | inverted(fifth, 6) | inverted(fourth, 5);
        let vector = (!first & 15) << 3;
        match self.width {
            Width::Four => {
                let w = u8::from(has_w) << 7;
                self.bytes.extend([0xc4, names | map, w | vector | 0b101, code]);
            }
            Width::Eight => {
                let last = 0b100_0000 | u8::from(is_repeated) << 4 | inverted(first >> 4, 3);
                let names = names | inverted(register >> 4, 4) | map;
                self.bytes.extend([0x62, names, 0x80 | vector | 0b101, last, code]);
            }
        }
    }

    fn place(&mut self, register: u8, source: Source) {
        let register = (register & 7) << 3;
        match source {
            Source::Register(last) => self.bytes.push(0b1100_0000 | register | last & 7),
            Source::Memory(Location { base, offset, .. }) => {
                self.bytes.push(0b1000_0000 | register | base as u8 & 7);
                self.bytes.extend(offset.to_le_bytes());
            }
        }
    }
}
