//! The kind of machine that a record is of, and the day.

/// Kind of machine in the names of records, from its number of cores and the text of `/proc/cpuinfo`: `2-core-xeon`.
pub fn kind(cores: usize, cpuinfo: &str) -> String {
    let model = field(cpuinfo, "model name").unwrap_or_default();
    let model = model.split('@').next().unwrap_or_default().replace("(R)", " ").replace("(TM)", " ");
    // Makers' names and the words that every processor has say nothing.
    let says_nothing = |word: &&str| {
        ["intel", "amd", "cpu", "processor"].contains(word)
            || word.ends_with("-core") && word.starts_with(|c: char| c.is_ascii_digit())
    };
    let model = model.to_lowercase();
    let mut words: Vec<&str> = model.split_whitespace().filter(|word| !says_nothing(word)).collect();
    if words.is_empty() {
        words.push(std::env::consts::ARCH);
    }
    format!("{cores}-core-{}", words.join("-"))
}

/// The processor in full: two kinds that share a name are told apart by their numbers.
pub fn processor(cpuinfo: &str) -> String {
    let of = |key| field(cpuinfo, key).unwrap_or("?");
    format!(
        "{} family {} model {} stepping {}",
        of("model name"),
        of("cpu family"),
        of("model"),
        of("stepping")
    )
}

fn field<'a>(cpuinfo: &'a str, key: &str) -> Option<&'a str> {
    let pairs = cpuinfo.lines().filter_map(|line| line.split_once(':'));
    pairs
        .map(|(name, value)| (name.trim(), value.trim()))
        .find(|(name, _)| *name == key)
        .map(|(_, value)| value)
}

/// The day as `YYYY-MM-DD`, from the days since 1 January 1970.
pub fn date(days: u64) -> String {
    let (mut year, mut day) = (1970, days);
    let is_leap =
        |year: u64| year.is_multiple_of(4) && (!year.is_multiple_of(100) || year.is_multiple_of(400));
    while day >= 365 + u64::from(is_leap(year)) {
        day -= 365 + u64::from(is_leap(year));
        year += 1;
    }
    let lengths = [31, 28 + u64::from(is_leap(year)), 31, 30, 31, 30, 31, 31, 30, 31, 30, 31];
    let mut month = 0;
    while day >= lengths[month] {
        day -= lengths[month];
        month += 1;
    }
    format!("{year:04}-{:02}-{:02}", month + 1, day + 1)
}
