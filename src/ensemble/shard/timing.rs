//! What the walls of all shards took, and on which kinds of processors.

use std::collections::BTreeMap;
use std::fs;
use std::io::ErrorKind;
use std::path::Path;

use crate::ensemble::RunError;
use crate::ensemble::files::publish;
use crate::ensemble::shard::{Work, array};
use crate::ensemble::table::{TIMING, TIMING_HEADS};

/// Puts the times of all shards together, shard by shard, and gives the numbers of the shards that were computed on each kind of
/// processor, as [`array()`] writes them. A shard whose file is gone has no times; no result depends on them.
///
/// # Errors
/// [`RunError::File`].
pub fn merged_timing(work: &Work, out: &Path) -> Result<BTreeMap<String, String>, RunError> {
    let mut processors: BTreeMap<String, Vec<u32>> = BTreeMap::new();
    publish(&out.join(TIMING), |file| {
        file.write_all(TIMING_HEADS.as_bytes())?;
        for share in work.shares() {
            let text = match fs::read_to_string(share.timing_file(out)) {
                Err(error) if error.kind() == ErrorKind::NotFound => continue,
                read => read?,
            };
            for line in text.lines().skip(1) {
                writeln!(file, "{line}")?;
                let processor = line.rsplit(',').next().unwrap_or_default();
                let shards = processors.entry(processor.to_owned()).or_default();
                if shards.last() != Some(&share.index) {
                    shards.push(share.index);
                }
            }
        }
        Ok(())
    })?;
    Ok(processors.into_iter().map(|(processor, shards)| (processor, array(&shards))).collect())
}
