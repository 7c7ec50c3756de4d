//! Numbers of shards as Slurm takes them in `--array`: "0,3-5,9".

/// Ascending numbers as text; empty for none.
pub fn array(numbers: &[u32]) -> String {
    let mut runs: Vec<[u32; 2]> = Vec::new();
    for &number in numbers {
        match runs.last_mut() {
            Some([_, last]) if *last + 1 == number => *last = number,
            _ => runs.push([number; 2]),
        }
    }
    let text = |[first, last]: &[u32; 2]| match first == last {
        true => first.to_string(),
        false => format!("{first}-{last}"),
    };
    runs.iter().map(text).collect::<Vec<_>>().join(",")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_are_written_as_slurm_takes_them() {
        for (numbers, text) in [
            (&[][..], ""),
            (&[7], "7"),
            (&[0, 1, 2, 3], "0-3"),
            (&[0, 3, 4, 5, 9], "0,3-5,9"),
            (&[1, 2, 4, 5], "1-2,4-5"),
        ] {
            assert_eq!(array(numbers), text);
        }
    }
}
