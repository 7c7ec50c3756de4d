//! Published statements against our numbers: what the studies' READMEs say comes out, does.

mod arrangements;
mod bearing;
mod diagnoses;
mod dry_shear_walls;
mod edge_restraint;
mod element_types;
mod joint_arrangement;
mod shaken_rocks;
mod tilting_block;
mod tilting_table;
