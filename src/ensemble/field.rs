//! Fields of records that are columns of tables: each is stated once, with its type, its unit and its meaning.

use crate::protocol::{Agreement, FailureMode, ShearMode, Verdict};
use crate::stats::fragility::Outcome as CollapseUnder;

/// What a column holds.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Kind {
    Text,
    Count,
    Real,
}

/// A value in a table. A count is always there.
pub enum Cell {
    Text(Option<String>),
    Count(u64),
    Real(Option<f64>),
}

impl Kind {
    /// Where a value may be missing: a count is a number then.
    pub const fn optional(self) -> Kind {
        match self {
            Kind::Text => Kind::Text,
            Kind::Count | Kind::Real => Kind::Real,
        }
    }
}

impl Cell {
    /// Of a value of a kind that may be missing.
    pub fn optional(value: Option<Cell>, kind: Kind) -> Cell {
        match (value, kind) {
            (Some(Cell::Count(n)), _) => Cell::Real(Some(n as f64)),
            (Some(cell), _) => cell,
            (None, Kind::Text) => Cell::Text(None),
            (None, Kind::Count | Kind::Real) => Cell::Real(None),
        }
    }
}

/// What a table can hold.
pub trait Field {
    /// In a column of this kind.
    const KIND: Kind;

    /// As a value of it.
    fn cell(&self) -> Cell;
}

impl<F: Field> Field for Option<F> {
    const KIND: Kind = F::KIND.optional();

    fn cell(&self) -> Cell {
        Cell::optional(self.as_ref().map(F::cell), F::KIND)
    }
}

macro_rules! fields {
    ($($kind:ident: $($of:ty)+ = |$value:ident| $cell:expr;)*) => {$($(
        impl Field for $of {
            const KIND: Kind = Kind::$kind;

            fn cell(&self) -> Cell {
                let $value = self;
                Cell::$kind($cell)
            }
        }
    )+)*};
}

fields! {
    Real: f64 = |x| Some(*x);
    Count: u32 = |n| u64::from(*n);
    Count: u64 = |n| *n;
    Text: String &'static str = |text| Some((*text).to_string());
    Text: Agreement FailureMode ShearMode Verdict CollapseUnder = |word| {
        serde_json::to_value(word).ok().and_then(|json| json.as_str().map(str::to_owned))
    };
}

/// A field of a record.
pub struct Entry<R> {
    /// Name of its column.
    pub name: &'static str,
    /// Its unit; empty where it has none.
    pub unit: &'static str,
    /// What it holds.
    pub meaning: &'static str,
    /// Of which kind it is.
    pub kind: Kind,
    /// The value of a record.
    pub cell: fn(&R) -> Cell,
}

/// A record whose fields are columns.
pub trait Record: Sized + 'static {
    /// Those of its fields, in their order.
    const COLUMNS: &'static [Entry<Self>];
}

/// A record: after each field the name of its column, its unit and its meaning, or nothing where it is no column.
macro_rules! record {
    ($(#[$about:meta])* $record:ident {
        $($(#[$meta:meta])* $field:ident: $kind:ty $(= $name:literal, $unit:literal, $meaning:literal)?;)*
    }) => {
        $(#[$about])*
        pub struct $record {
            $($(#[$meta])* $(#[doc = $meaning])? pub $field: $kind,)*
        }

        impl $crate::ensemble::field::Record for $record {
            const COLUMNS: &'static [$crate::ensemble::field::Entry<Self>] = &[$($($crate::ensemble::field::Entry {
                name: $name,
                unit: $unit,
                meaning: $meaning,
                kind: <$kind as $crate::ensemble::field::Field>::KIND,
                cell: |record| $crate::ensemble::field::Field::cell(&record.$field),
            },)?)*];
        }
    };
}

pub(super) use record;
