//! Studies: raw text to checked types, with every fault of a file reported at once.
