//! Where a number stands that is infinite or not a number, in any value that can be written down.

use std::fmt::Display;

use serde::ser::{
    Error, Serialize, SerializeMap, SerializeSeq, SerializeStruct, SerializeStructVariant, SerializeTuple,
    SerializeTupleStruct, SerializeTupleVariant, Serializer,
};

/// Where in a value, such as `energy.drift_J`, a number stands that is not finite, if one does.
///
/// What is not known is `None`, and no number; so a summary never says `NaN`.
pub fn not_finite<T: Serialize + ?Sized>(value: &T) -> Option<String> {
    value.serialize(Search).err().map(|Found(place)| place)
}

/// Goes through a value; its only error is what it looks for.
struct Search;

/// Where it stands.
#[derive(Debug, thiserror::Error)]
#[error("{0} is not finite")]
struct Found(String);

impl Found {
    fn below(self, key: impl Display) -> Self {
        Self(if self.0.is_empty() { key.to_string() } else { format!("{key}.{}", self.0) })
    }
}

impl Error for Found {
    fn custom<T: Display>(message: T) -> Self {
        Self(message.to_string())
    }
}

fn look<T: Serialize + ?Sized>(key: impl Display, value: &T) -> Result<(), Found> {
    value.serialize(Search).map_err(|found| found.below(key))
}

/// What holds no fraction is finite.
macro_rules! finite {
    ($($method:ident: $kind:ty),*) => { $(
        fn $method(self, _: $kind) -> Result<(), Found> {
            Ok(())
        }
    )* };
}

impl Serializer for Search {
    type Ok = ();
    type Error = Found;
    type SerializeSeq = Entries;
    type SerializeTuple = Entries;
    type SerializeTupleStruct = Entries;
    type SerializeTupleVariant = Entries;
    type SerializeMap = Entries;
    type SerializeStruct = Entries;
    type SerializeStructVariant = Entries;

    finite! {
        serialize_bool: bool, serialize_i8: i8, serialize_i16: i16, serialize_i32: i32, serialize_i64: i64,
        serialize_u8: u8, serialize_u16: u16, serialize_u32: u32, serialize_u64: u64, serialize_char: char,
        serialize_str: &str, serialize_bytes: &[u8], serialize_unit_struct: &'static str
    }

    fn serialize_f32(self, value: f32) -> Result<(), Found> {
        self.serialize_f64(f64::from(value))
    }

    fn serialize_f64(self, value: f64) -> Result<(), Found> {
        if value.is_finite() { Ok(()) } else { Err(Found(String::new())) }
    }

    fn serialize_none(self) -> Result<(), Found> {
        Ok(())
    }

    fn serialize_some<T: Serialize + ?Sized>(self, value: &T) -> Result<(), Found> {
        value.serialize(self)
    }

    fn serialize_unit(self) -> Result<(), Found> {
        Ok(())
    }

    fn serialize_unit_variant(self, _: &'static str, _: u32, _: &'static str) -> Result<(), Found> {
        Ok(())
    }

    fn serialize_newtype_struct<T: Serialize + ?Sized>(
        self,
        _: &'static str,
        value: &T,
    ) -> Result<(), Found> {
        value.serialize(self)
    }

    fn serialize_newtype_variant<T: Serialize + ?Sized>(
        self,
        _: &'static str,
        _: u32,
        variant: &'static str,
        value: &T,
    ) -> Result<(), Found> {
        look(variant, value)
    }

    fn serialize_seq(self, _: Option<usize>) -> Result<Entries, Found> {
        Ok(Entries::default())
    }

    fn serialize_tuple(self, _: usize) -> Result<Entries, Found> {
        Ok(Entries::default())
    }

    fn serialize_tuple_struct(self, _: &'static str, _: usize) -> Result<Entries, Found> {
        Ok(Entries::default())
    }

    fn serialize_tuple_variant(
        self,
        _: &'static str,
        _: u32,
        _: &'static str,
        _: usize,
    ) -> Result<Entries, Found> {
        Ok(Entries::default())
    }

    fn serialize_map(self, _: Option<usize>) -> Result<Entries, Found> {
        Ok(Entries::default())
    }

    fn serialize_struct(self, _: &'static str, _: usize) -> Result<Entries, Found> {
        Ok(Entries::default())
    }

    fn serialize_struct_variant(
        self,
        _: &'static str,
        _: u32,
        _: &'static str,
        _: usize,
    ) -> Result<Entries, Found> {
        Ok(Entries::default())
    }
}

/// Entries of a list or a table, one after another.
#[derive(Default)]
struct Entries {
    number: usize,
    key: String,
}

impl Entries {
    fn next<T: Serialize + ?Sized>(&mut self, value: &T) -> Result<(), Found> {
        self.number += 1;
        look(self.number - 1, value)
    }
}

macro_rules! lists {
    ($($kind:ident: $method:ident),*) => { $(
        impl $kind for Entries {
            type Ok = ();
            type Error = Found;

            fn $method<T: Serialize + ?Sized>(&mut self, value: &T) -> Result<(), Found> {
                self.next(value)
            }

            fn end(self) -> Result<(), Found> {
                Ok(())
            }
        }
    )* };
}
lists! {
    SerializeSeq: serialize_element, SerializeTuple: serialize_element, SerializeTupleStruct: serialize_field,
    SerializeTupleVariant: serialize_field
}

macro_rules! tables {
    ($($kind:ident),*) => { $(
        impl $kind for Entries {
            type Ok = ();
            type Error = Found;

            fn serialize_field<T: Serialize + ?Sized>(&mut self, key: &'static str, value: &T) -> Result<(), Found> {
                look(key, value)
            }

            fn end(self) -> Result<(), Found> {
                Ok(())
            }
        }
    )* };
}
tables! { SerializeStruct, SerializeStructVariant }

impl SerializeMap for Entries {
    type Ok = ();
    type Error = Found;

    /// Keys that are no text count as 0, 1, 2 ...
    fn serialize_key<T: Serialize + ?Sized>(&mut self, key: &T) -> Result<(), Found> {
        let text = serde_json::to_value(key).ok();
        self.key =
            text.as_ref().and_then(|text| text.as_str()).map_or(self.number.to_string(), str::to_owned);
        self.number += 1;
        Ok(())
    }

    fn serialize_value<T: Serialize + ?Sized>(&mut self, value: &T) -> Result<(), Found> {
        look(std::mem::take(&mut self.key), value)
    }

    fn end(self) -> Result<(), Found> {
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use std::collections::BTreeMap;

    use super::*;

    #[derive(serde::Serialize)]
    struct Inner {
        quantity: f64,
        list: Vec<f64>,
        unknown: Option<f64>,
    }

    #[derive(serde::Serialize)]
    struct Outer {
        #[serde(flatten)]
        inner: Inner,
        more: Vec<Inner>,
    }

    fn outer(quantity: f64, last: f64) -> Outer {
        let inner = |quantity, last| Inner { quantity, list: vec![1.5, last], unknown: None };
        Outer { inner: inner(quantity, 0.0), more: vec![inner(0.0, 1.0), inner(-0.0, last)] }
    }

    #[test]
    fn numbers_that_are_not_finite_are_found_wherever_they_stand() {
        assert_eq!(not_finite(&outer(1.0, -2.0)), None);
        assert_eq!(not_finite(&outer(f64::NAN, 0.0)).as_deref(), Some("quantity"));
        assert_eq!(not_finite(&outer(1.0, f64::NEG_INFINITY)).as_deref(), Some("more.1.list.1"));
    }

    #[derive(serde::Serialize)]
    enum Kind {
        New(f64),
        Pair(f64, f64),
        Named { length: f64 },
    }

    #[test]
    fn every_shape_of_a_value_is_gone_through() {
        let nan = f64::NAN;
        let place = |kind: &Kind| not_finite(kind).unwrap();
        assert_eq!(place(&Kind::New(nan)), "New");
        assert_eq!(place(&Kind::Pair(0.0, nan)), "1");
        assert_eq!(place(&Kind::Named { length: nan }), "length");
        assert_eq!(not_finite(&BTreeMap::from([("a", 1.0), ("b", nan)])).unwrap(), "b");
        assert_eq!(not_finite(&BTreeMap::from([(7_u32, nan)])).unwrap(), "0");
        assert_eq!(not_finite(&(1_u64 << 63, true, "text", Some(f32::INFINITY))).unwrap(), "3");
        assert_eq!(not_finite(&[Some(1.0), None]), None);
    }
}
