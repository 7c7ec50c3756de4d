//! The `pirca` program: see [`pirca::cli`].

fn main() {}
