//! CSV that other programs read without asking: names quoted where they must be, numbers that read back to the same bits, nothing where
//! there is no value.

use crate::math::Vec3;

/// A CSV, line by line.
pub(crate) struct Csv(String);

impl Csv {
    /// With the names of its columns, which commas separate.
    pub fn new(heads: impl Into<String>) -> Csv {
        Csv(heads.into() + "\n")
    }

    /// Adds a line.
    pub fn line(&mut self, cells: &[&dyn Cell]) {
        let mut line = Vec::with_capacity(cells.len());
        cells.iter().for_each(|cell| cell.write(&mut line));
        self.0 += &(line.join(",") + "\n");
    }

    /// Its text.
    pub fn text(self) -> String {
        self.0
    }

    /// Its bytes.
    pub fn bytes(self) -> Vec<u8> {
        self.0.into_bytes()
    }
}

/// What stands in one column or in several beside each other.
pub(crate) trait Cell {
    /// Writes it behind the cells of a line.
    fn write(&self, line: &mut Vec<String>);
}

/// What takes the same number of columns whatever it is.
pub(crate) trait Columns: Cell {
    /// That number.
    const COLUMNS: usize;
}

macro_rules! plain {
    ($($of:ty)*) => {$(
        impl Cell for $of {
            fn write(&self, line: &mut Vec<String>) {
                line.push(self.to_string());
            }
        }
        impl Columns for $of {
            const COLUMNS: usize = 1;
        }
    )*};
}
plain!(f64 u32 u64 usize bool);

macro_rules! names {
    ($($of:ty)*) => {$(
        impl Cell for $of {
            fn write(&self, line: &mut Vec<String>) {
                line.push(quoted(self));
            }
        }
        impl Columns for $of {
            const COLUMNS: usize = 1;
        }
    )*};
}
names!(&str String);

impl Cell for Vec3 {
    fn write(&self, line: &mut Vec<String>) {
        [self.x, self.y, self.z].write(line);
    }
}

impl Columns for Vec3 {
    const COLUMNS: usize = 3;
}

impl<T: Columns, const N: usize> Cell for [T; N] {
    fn write(&self, line: &mut Vec<String>) {
        self.iter().for_each(|cell| cell.write(line));
    }
}

impl<T: Columns, const N: usize> Columns for [T; N] {
    const COLUMNS: usize = N * T::COLUMNS;
}

impl<T: Columns> Cell for Option<T> {
    fn write(&self, line: &mut Vec<String>) {
        match self {
            Some(cell) => cell.write(line),
            None => line.extend(vec![String::new(); T::COLUMNS]),
        }
    }
}

impl<T: Columns> Columns for Option<T> {
    const COLUMNS: usize = T::COLUMNS;
}

impl<T: Columns> Cell for Vec<T> {
    fn write(&self, line: &mut Vec<String>) {
        self.iter().for_each(|cell| cell.write(line));
    }
}

/// A name as a CSV field (RFC 4180).
fn quoted(name: &str) -> String {
    match name.contains([',', '"', '\n', '\r']) {
        true => format!("\"{}\"", name.replace('"', "\"\"")),
        false => name.to_string(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_are_quoted_where_they_must_be_and_what_is_missing_takes_its_columns() {
        let mut csv = Csv::new("arm,mean,low,high,walls");
        csv.line(&[&"a, \"b\"", &Some(0.1), &Some([0.05, 1e-7]), &3_u64]);
        csv.line(&[&"plain".to_owned(), &None::<f64>, &None::<[f64; 2]>, &3_u64]);
        assert_eq!(
            csv.text(),
            "arm,mean,low,high,walls\n\"a, \"\"b\"\"\",0.1,0.05,0.0000001,3\nplain,,,,3\n"
        );
    }
}
