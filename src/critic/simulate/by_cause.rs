//! What is simulated of a cause once and asked for often.

use std::collections::BTreeMap;
use std::sync::{Arc, Mutex};

use crate::critic::simulate::causes::Causes;

/// Things that are pure functions of causes and a seed, as far as they have been asked for. Where many campaigns are judged, most
/// questions are of the same few causes; pairs are many, seldom asked of twice, and not kept.
#[derive(Debug)]
pub struct ByCause<T>(Mutex<BTreeMap<(Causes, u64), Arc<T>>>);

impl<T> Default for ByCause<T> {
    fn default() -> Self {
        ByCause(Mutex::default())
    }
}

impl<T> ByCause<T> {
    /// That of causes with a seed, simulated if it is not there yet.
    pub fn of(&self, (causes, seed): (Causes, u64), simulated: impl FnOnce() -> T) -> Arc<T> {
        if !causes.is_single() {
            return Arc::new(simulated());
        }
        let all = || self.0.lock().expect("nothing panics that holds it");
        let before = all().get(&(causes, seed)).cloned();
        // All threads simulate: none may wait here meanwhile. Two that ask at once simulate the same.
        before.unwrap_or_else(|| {
            let own = Arc::new(simulated());
            all().entry((causes, seed)).or_insert(own).clone()
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_was_asked_for_is_simulated_once_but_for_pairs() {
        let (kept, mut count) = (ByCause::default(), 0);
        let (one, pair) = (Causes::from(Some(3)), Causes::pair(3, 4));
        for of in [(one, 1), (one, 2), (one, 1), (pair, 1), (pair, 1), (Causes::from(Some(4)), 1)] {
            let own = kept.of(of, || {
                count += 1;
                of
            });
            assert_eq!(*own, of);
        }
        assert_eq!(count, 5);
    }
}
