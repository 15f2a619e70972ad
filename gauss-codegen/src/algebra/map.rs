//! Maps and sets for small keys. Macros run unoptimised, where a look-up in the standard maps takes hundreds of
//! instructions: these are made of plain loops over slices. Keys are indices and short sequences of them, and nobody
//! chooses them to collide. What they hold is gone through in the order in which it came, so that nothing depends on
//! addresses.

use std::ops::Index;

/// Any odd number whose digits look random.
const SPREAD: u64 = 0x9e37_79b9_7f4a_7c15;

/// The keys of a map.
pub trait Key: Eq {
    /// A number that differs where keys do, nearly always.
    fn word(&self) -> u64;
}

/// Two words as one.
pub const fn joined(a: u64, b: u64) -> u64 {
    (a.rotate_left(29) ^ b).wrapping_mul(SPREAD)
}

impl Key for u32 {
    fn word(&self) -> u64 {
        *self as u64
    }
}

impl Key for usize {
    fn word(&self) -> u64 {
        *self as u64
    }
}

impl Key for i32 {
    fn word(&self) -> u64 {
        *self as u64
    }
}

impl<K: Key> Key for &K {
    fn word(&self) -> u64 {
        (**self).word()
    }
}

impl<A: Key, B: Key> Key for (A, B) {
    fn word(&self) -> u64 {
        joined(self.0.word(), self.1.word())
    }
}

impl<A: Key, B: Key, C: Key> Key for (A, B, C) {
    fn word(&self) -> u64 {
        joined(joined(self.0.word(), self.1.word()), self.2.word())
    }
}

/// Places in a list, found by the words of the keys there: open addressing with at least half of the slots free.
#[derive(Clone, Default)]
pub(super) struct Places {
    /// The first half of the spread word, then one more than the place; zero where free.
    slots: Box<[u64]>,
    /// Shift that leaves the digits of a slot of a spread word.
    shift: u32,
    count: usize,
}

/// Bits of a slot where the half of a word stands.
const TAG: u64 = !0 << 32;

impl Places {
    /// The place of the key that has this word and is the `same`.
    pub fn find(&self, word: u64, same: impl Fn(usize) -> bool) -> Option<usize> {
        let slots = &*self.slots;
        if slots.is_empty() {
            return None;
        }
        let (spread, mask) = (word.wrapping_mul(SPREAD), slots.len() - 1);
        let mut slot = (spread >> self.shift) as usize;
        loop {
            let held = slots[slot];
            if held == 0 {
                return None;
            }
            if (held ^ spread) & TAG == 0 {
                let place = (held & !TAG) as usize - 1;
                if same(place) {
                    return Some(place);
                }
            }
            slot = (slot + 1) & mask;
        }
    }

    /// Takes up the end of the list, which was not found.
    pub fn push(&mut self, word: u64) {
        if 2 * self.count >= self.slots.len() {
            self.grow();
        }
        self.count += 1;
        let held = word.wrapping_mul(SPREAD) & TAG | self.count as u64;
        put(&mut self.slots, self.shift, held);
    }

    fn grow(&mut self) {
        /// Digits that select one of the first slots, and how many are added at a time.
        const DIGITS: u32 = 4;
        const MORE: u32 = 2;
        let digits = if self.slots.is_empty() { DIGITS } else { 64 - self.shift + MORE };
        let (mut slots, mut held) = (vec![0; 1 << digits].into_boxed_slice(), vec![0; self.count].into_boxed_slice());
        // In the order of the list, which `truncate` relies on.
        let (old, mut k) = (&*self.slots, 0);
        while k < old.len() {
            let slot = old[k];
            if slot != 0 {
                held[(slot & !TAG) as usize - 1] = slot;
            }
            k += 1;
        }
        self.shift = 64 - digits;
        k = 0;
        while k < held.len() {
            put(&mut slots, self.shift, held[k]);
            k += 1;
        }
        self.slots = slots;
    }

    /// Forgets the last of the list, of which these are the words, the last first. On the way to what came before they
    /// do not stand, for each took the first free slot.
    pub fn truncate(&mut self, words: impl Iterator<Item = u64>) {
        for word in words {
            let slots = &mut *self.slots;
            let mask = slots.len() - 1;
            let mut slot = (word.wrapping_mul(SPREAD) >> self.shift) as usize;
            while slots[slot] & !TAG != self.count as u64 {
                slot = (slot + 1) & mask;
            }
            slots[slot] = 0;
            self.count -= 1;
        }
    }
}

/// Into the first free slot.
fn put(slots: &mut [u64], shift: u32, held: u64) {
    let mask = slots.len() - 1;
    let mut slot = (held >> shift) as usize;
    while slots[slot] != 0 {
        slot = (slot + 1) & mask;
    }
    slots[slot] = held;
}

/// A map that keeps the order in which keys came.
#[derive(Clone)]
pub struct Map<K, V> {
    places: Places,
    entries: Vec<(K, V)>,
}

impl<K, V> Default for Map<K, V> {
    fn default() -> Self {
        Self { places: Places::default(), entries: Vec::new() }
    }
}

impl<K: Key, V> Map<K, V> {
    fn place(&self, word: u64, key: &K) -> Option<usize> {
        let entries: &[(K, V)] = &self.entries;
        self.places.find(word, |place| entries[place].0 == *key)
    }

    fn push(&mut self, word: u64, key: K, value: V) -> usize {
        self.places.push(word);
        self.entries.push((key, value));
        self.entries.len() - 1
    }

    /// The value of a key.
    pub fn get(&self, key: &K) -> Option<&V> {
        match self.place(key.word(), key) {
            Some(place) => Some(&self.entries[place].1),
            None => None,
        }
    }

    /// The value of a key, which may be changed.
    pub fn get_mut(&mut self, key: &K) -> Option<&mut V> {
        match self.place(key.word(), key) {
            Some(place) => Some(&mut self.entries[place].1),
            None => None,
        }
    }

    /// Whether the key has a value.
    pub fn contains_key(&self, key: &K) -> bool {
        self.place(key.word(), key).is_some()
    }

    /// Gives a key a value; what it had before.
    pub fn insert(&mut self, key: K, value: V) -> Option<V> {
        let word = key.word();
        if let Some(place) = self.place(word, &key) {
            return Some(std::mem::replace(&mut self.entries[place].1, value));
        }
        self.push(word, key, value);
        None
    }

    /// The value of a key, which has one afterwards.
    pub fn or_insert_with(&mut self, key: K, value: impl FnOnce() -> V) -> &mut V {
        self.or_insert_of(key, |_| value())
    }

    /// The same of a value that is made of the key.
    pub fn or_insert_of(&mut self, key: K, value: impl FnOnce(&K) -> V) -> &mut V {
        let word = key.word();
        let place = match self.place(word, &key) {
            Some(place) => place,
            None => {
                let value = value(&key);
                self.push(word, key, value)
            }
        };
        &mut self.entries[place].1
    }

    /// Number of keys that have values.
    pub fn len(&self) -> usize {
        self.entries.len()
    }

    /// Whether no key has.
    pub fn is_empty(&self) -> bool {
        self.entries.is_empty()
    }

    /// All keys with their values.
    pub fn iter(&self) -> impl Iterator<Item = (&K, &V)> {
        self.entries.iter().map(|(key, value)| (key, value))
    }

    /// All keys.
    pub fn keys(&self) -> impl Iterator<Item = &K> {
        self.entries.iter().map(|(key, _)| key)
    }

    /// All values.
    pub fn values(&self) -> impl Iterator<Item = &V> {
        self.entries.iter().map(|(_, value)| value)
    }

    /// All values, which may be changed.
    pub fn values_mut(&mut self) -> impl Iterator<Item = &mut V> {
        self.entries.iter_mut().map(|(_, value)| value)
    }
}

impl<K: Key, V> Index<&K> for Map<K, V> {
    type Output = V;

    fn index(&self, key: &K) -> &V {
        self.get(key).expect("a key that has a value")
    }
}

impl<K: Key, V> Extend<(K, V)> for Map<K, V> {
    fn extend<I: IntoIterator<Item = (K, V)>>(&mut self, pairs: I) {
        for (key, value) in pairs {
            self.insert(key, value);
        }
    }
}

impl<K: Key, V> FromIterator<(K, V)> for Map<K, V> {
    fn from_iter<I: IntoIterator<Item = (K, V)>>(pairs: I) -> Self {
        let mut map = Self::default();
        map.extend(pairs);
        map
    }
}

impl<K, V> IntoIterator for Map<K, V> {
    type Item = (K, V);
    type IntoIter = std::vec::IntoIter<(K, V)>;

    fn into_iter(self) -> Self::IntoIter {
        self.entries.into_iter()
    }
}

/// A set that keeps the order in which its members came.
#[derive(Clone)]
pub struct Set<K>(Map<K, ()>);

impl<K> Default for Set<K> {
    fn default() -> Self {
        Self(Map::default())
    }
}

impl<K: Key> Set<K> {
    /// Takes it up; whether it is new.
    pub fn insert(&mut self, key: K) -> bool {
        self.0.insert(key, ()).is_none()
    }

    /// Whether it is a member.
    pub fn contains(&self, key: &K) -> bool {
        self.0.contains_key(key)
    }
}

impl<K: Key> FromIterator<K> for Set<K> {
    fn from_iter<I: IntoIterator<Item = K>>(keys: I) -> Self {
        Self(keys.into_iter().map(|key| (key, ())).collect())
    }
}

#[cfg(test)]
mod tests {
    use std::collections::BTreeMap;

    use super::{Key, Map, Places, Set};

    /// Keys of which hundreds have one word.
    #[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
    struct Alike(u32);

    impl Key for Alike {
        fn word(&self) -> u64 {
            u64::from(self.0 % 3)
        }
    }

    fn numbers() -> impl Iterator<Item = u32> {
        (0..2000_u32).map(|k| k.wrapping_mul(2_654_435_761) >> 22)
    }

    /// A map holds the same as the standard map after the same work, in the order in which keys came.
    fn as_the_standard<K: Key + Copy + Ord + std::fmt::Debug>(key: impl Fn(u32) -> K) {
        let (mut map, mut standard, mut order) = (Map::default(), BTreeMap::new(), Vec::new());
        for (k, n) in numbers().enumerate() {
            let key = key(n);
            assert_eq!(map.get(&key), standard.get(&key));
            if !standard.contains_key(&key) {
                order.push(key);
            }
            if k % 3 == 0 {
                assert_eq!(map.insert(key, k), standard.insert(key, k));
            } else {
                *map.or_insert_with(key, || 7) += k;
                *standard.entry(key).or_insert(7) += k;
            }
        }
        assert_eq!(map.len(), standard.len());
        assert!(map.keys().eq(&order) && order.iter().all(|key| map[key] == standard[key]));
        assert!(map.into_iter().all(|(key, value)| standard.remove(&key) == Some(value)) && standard.is_empty());
    }

    #[test]
    fn maps_hold_what_the_standard_ones_hold() {
        as_the_standard(|n| n);
        as_the_standard(|n| (n % 30, n as usize / 30));
        as_the_standard(Alike);
        let set: Set<u32> = numbers().filter(|n| n % 2 == 0).collect();
        assert!(numbers().all(|n| set.contains(&n) == (n % 2 == 0)));
    }

    /// Whenever the end of a list is forgotten, what is left is found, and nothing else.
    #[test]
    fn ends_of_lists_are_forgotten() {
        let (mut places, mut list) = (Places::default(), Vec::<Alike>::new());
        for n in 0..200 {
            list.push(Alike(n));
            places.push(Alike(n).word());
            if n % 7 == 0 {
                let gone = list.split_off(list.len() * 2 / 3);
                places.truncate(gone.iter().rev().map(Key::word));
            }
            for k in 0..200 {
                let found = places.find(Alike(k).word(), |place| list[place] == Alike(k));
                assert_eq!(found, list.iter().position(|key| *key == Alike(k)));
            }
        }
    }
}
