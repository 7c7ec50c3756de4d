//! The native part of the Python package: the command line as a function, and tables by the Arrow C stream. What a user meets is in
//! `pirca/*.py`; what is computed is in the library, and nothing of it is here.
//!
//! PyO3 serves without its macros: they alone would have every dependency of the library compiled a second time, with other features
//! of `syn`. Four functions need none.

mod ask;
mod module;
mod table;
