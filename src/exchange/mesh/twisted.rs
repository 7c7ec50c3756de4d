//! Files with something wrong, for the tests of the readers.

/// Words that no reader likes.
const WORDS: [&str; 12] =
    ["nan", "-inf", "1e400", "-1", "99999999999", "4294967295", "0", "", "1e-400", "0x1", "solid", "\n"];

/// Hands over a file, cut and changed in sixty ways that are the same every time.
pub(in crate::exchange) fn twisted(whole: &[u8], mut read: impl FnMut(&[u8])) {
    let mut state = 72_u64;
    // SplitMix64.
    let mut below = |most: usize| {
        state = state.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mixed = (state ^ (state >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        let mixed = (mixed ^ (mixed >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        ((mixed ^ (mixed >> 31)) % most.max(1) as u64) as usize
    };
    for kind in (0..60).map(|turn| turn % 6) {
        let mut own = whole.to_vec();
        let at = below(own.len());
        match kind {
            0 => own.truncate(at),
            // Large counts, infinities and the like.
            1 => own.iter_mut().skip(at).take(4).for_each(|byte| *byte = 0xff),
            2 => (0..8).for_each(|_| own[below(whole.len())] = below(256) as u8),
            3 => {
                let word = own[at..].iter().position(u8::is_ascii_whitespace).map_or(at, |more| at + more);
                let end = own[word..].iter().skip(1).position(u8::is_ascii_whitespace);
                let end = end.map_or(own.len(), |more| word + 1 + more);
                let new = format!(" {}", WORDS[below(WORDS.len())]);
                own.splice(word..end, new.into_bytes());
            }
            4 => {
                let other = below(own.len());
                own.swap(at, other);
            }
            _ => {
                let piece = own[at..(at + below(40)).min(own.len())].to_vec();
                let other = below(own.len());
                own.splice(other..other, piece);
            }
        }
        read(&own);
    }
}
