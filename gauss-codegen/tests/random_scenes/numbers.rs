//! Pseudo-random choices, and numbers as people write them: short, long, tiny, huge.

use crate::random::Random;

impl Random {
    /// True once in `n` times.
    pub fn once_in(&mut self, n: usize) -> bool {
        self.below(n) == 0
    }

    /// Between 1 and 10, with so many digits.
    fn digits(&mut self, count: usize) -> String {
        let fraction: String = (1..count).map(|_| char::from(b'0' + self.below(10) as u8)).collect();
        format!("{}.{fraction}", 1 + self.below(9))
    }

    /// A positive number of order one.
    pub fn ordinary(&mut self) -> String {
        match self.below(6) {
            0 => (1 + self.below(9)).to_string(),
            1 => format!("0.{}", 1 + self.below(99)),
            2 => format!("{}.{}", 1 + self.below(99), self.below(10)),
            3 => self.digits(3),
            4 => self.digits(14),
            // More than any fraction of 64-bit integers has.
            _ => {
                let count = 18 + self.below(10);
                self.digits(count)
            }
        }
    }

    /// A positive number of whatever size, from 1e-8 to 1e8.
    pub fn positive(&mut self) -> String {
        match self.below(4) {
            0 => format!("1e{}", self.below(17) as i64 - 8),
            1 => format!("{}e{}", self.ordinary(), self.below(17) as i64 - 8),
            2 => (1 + self.below(999)).to_string(),
            _ => self.ordinary(),
        }
    }

    /// A number of either sign, sometimes zero.
    pub fn number(&mut self) -> String {
        match self.below(5) {
            0 => "0".into(),
            1 | 2 => format!("-{}", self.positive()),
            _ => self.positive(),
        }
    }

    /// A coefficient: a number, a field, or a product of both.
    pub fn coefficient(&mut self) -> String {
        match self.below(4) {
            0 => "k".into(),
            1 => format!("{} * l", self.positive()),
            2 => format!("k / {}", self.positive()),
            _ => self.positive(),
        }
    }

    pub fn vector(&mut self, mut component: impl FnMut(&mut Self) -> String) -> String {
        let [a, b, c] = [component(self), component(self), component(self)];
        format!("[{a}, {b}, {c}]")
    }
}
