//! The invariant check that stays on in release.

/// Panics with a message when one of our own invariants is broken, also in release builds.
///
/// Tests and binary share the release profile, in which `debug_assert!` is off; an invariant that guards a
/// published number must hold there. Keep the condition cheap. Never for user input: that gets a typed error.
#[macro_export]
macro_rules! check {
    ($condition:expr, $($message:tt)+) => {
        let holds: bool = $condition;
        if !holds {
            panic!("invariant broken: {}", format_args!($($message)+));
        }
    };
}
