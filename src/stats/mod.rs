//! Statistics on plain slices: moments, COV, intervals, bootstrap. Every statistic comes with its interval.
