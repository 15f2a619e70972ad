//! Vectors as data: a map by names where these are known, else a list.

use core::fmt;
use core::marker::PhantomData;

use serde::de::{Deserialize, DeserializeSeed, Deserializer, Error, MapAccess, SeqAccess, Visitor};
use serde::ser::{Serialize, SerializeStruct, SerializeTuple, Serializer};

use crate::configuration::VectorSpace;
use crate::real::Real;

/// Names of the numbers of a vector.
#[derive(Clone, Copy)]
pub struct Names {
    known: &'static [&'static str],
    count: usize,
}

impl Names {
    /// Names of all numbers, or else none.
    pub fn of(known: &'static [&'static str], count: usize) -> Self {
        Self { known: if known.len() == count { known } else { &[] }, count }
    }

    pub fn name(self, i: usize) -> Name {
        Name { known: self.known.get(i).copied(), i }
    }
}

/// A name, or the place in the order.
pub struct Name {
    known: Option<&'static str>,
    i: usize,
}

impl fmt::Display for Name {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self.known {
            Some(name) => f.write_str(name),
            None => write!(f, "number {}", self.i),
        }
    }
}

/// A vector on its way to data and back.
pub struct Numbers<T, V> {
    vector: V,
    scalar: PhantomData<T>,
}

impl<T: Real, V: VectorSpace<T>> Numbers<T, V> {
    pub fn new(vector: V) -> Self {
        Self { vector, scalar: PhantomData }
    }

    pub fn serialize<W: Serializer>(self, names: Names, serializer: W) -> Result<W::Ok, W::Error>
    where
        T: Serialize,
    {
        if names.known.is_empty() {
            let mut list = serializer.serialize_tuple(V::DIM)?;
            for i in 0..V::DIM {
                list.serialize_element(&self.vector.component(i))?;
            }
            return list.end();
        }
        let mut map = serializer.serialize_struct("Numbers", V::DIM)?;
        for (i, &name) in names.known.iter().enumerate() {
            map.serialize_field(name, &self.vector.component(i))?;
        }
        map.end()
    }

    pub fn read<'de, D: Deserializer<'de>>(names: Names, deserializer: D) -> Result<V, D::Error>
    where
        T: Deserialize<'de>,
    {
        let reader = Reader { names, vector: PhantomData::<(T, V)> };
        if names.known.is_empty() {
            deserializer.deserialize_tuple(names.count, reader)
        } else {
            deserializer.deserialize_struct("Numbers", names.known, reader)
        }
    }
}

struct Reader<T, V> {
    names: Names,
    vector: PhantomData<(T, V)>,
}

impl<'de, T: Real + Deserialize<'de>, V: VectorSpace<T>> Visitor<'de> for Reader<T, V> {
    type Value = V;

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{} numbers", V::DIM)?;
        let mut separator = ": ";
        for name in self.names.known {
            write!(f, "{separator}{name}")?;
            separator = ", ";
        }
        Ok(())
    }

    fn visit_seq<A: SeqAccess<'de>>(self, mut list: A) -> Result<V, A::Error> {
        let mut vector = V::zero();
        for i in 0..V::DIM {
            let number = list.next_element()?.ok_or_else(|| A::Error::invalid_length(i, &self))?;
            vector.set_component(i, number);
        }
        Ok(vector)
    }

    fn visit_map<A: MapAccess<'de>>(self, mut map: A) -> Result<V, A::Error> {
        let (mut vector, known) = (V::zero(), self.names.known);
        // Ones where a number has been read: a list of flags without an allocator.
        let mut seen = V::zero();
        let is_there = |seen: &V, i: usize| seen.component(i).lane(0) == 1.0;
        while let Some(i) = map.next_key_seed(Key(known))? {
            if is_there(&seen, i) {
                return Err(A::Error::duplicate_field(known[i]));
            }
            seen.set_component(i, T::one());
            vector.set_component(i, map.next_value()?);
        }
        match (0..V::DIM).find(|&i| !is_there(&seen, i)) {
            Some(missing) => Err(A::Error::missing_field(known[missing])),
            None => Ok(vector),
        }
    }
}

/// The place of a name among those that are known.
struct Key(&'static [&'static str]);

impl<'de> DeserializeSeed<'de> for Key {
    type Value = usize;

    fn deserialize<D: Deserializer<'de>>(self, deserializer: D) -> Result<usize, D::Error> {
        deserializer.deserialize_identifier(self)
    }
}

impl Visitor<'_> for Key {
    type Value = usize;

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("the name of a number")
    }

    fn visit_str<E: Error>(self, word: &str) -> Result<usize, E> {
        self.0.iter().position(|&name| name == word).ok_or_else(|| E::unknown_field(word, self.0))
    }
}
