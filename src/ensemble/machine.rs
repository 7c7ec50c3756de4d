//! On what walls are evaluated: kept beside the results, as no result may depend on it.

use std::fs;

/// The machine's name.
pub(super) fn host() -> String {
    let named =
        fs::read_to_string("/proc/sys/kernel/hostname").ok().or_else(|| std::env::var("HOSTNAME").ok());
    named
        .map(|name| name.trim().to_string())
        .filter(|name| !name.is_empty())
        .unwrap_or_else(|| "unknown".to_string())
}

/// The kind of processor, with those of its instructions by which numerical libraries choose how they add up: results have the same bits on
/// machines of one kind, and may differ in their last digits between two kinds.
pub(super) fn processor() -> String {
    let found = instructions().into_iter().filter_map(|(name, is_there)| is_there.then_some(name));
    std::iter::once(std::env::consts::ARCH).chain(found).collect::<Vec<_>>().join(" ")
}

#[cfg(target_arch = "x86_64")]
fn instructions() -> Vec<(&'static str, bool)> {
    vec![
        ("avx2", std::arch::is_x86_feature_detected!("avx2")),
        ("fma", std::arch::is_x86_feature_detected!("fma")),
        ("avx512f", std::arch::is_x86_feature_detected!("avx512f")),
    ]
}

/// Others have none that are chosen by.
#[cfg(not(target_arch = "x86_64"))]
fn instructions() -> Vec<(&'static str, bool)> {
    Vec::new()
}
