//! What is not about stones leaves every stone as it was: streams are keyed by seed, member and quantity alone.

use std::fs;

use crate::fixture::{Folder, STUDY, changed, stderr};

/// A wall of the random arm, as the program writes it: member 5 unless `more` says another.
fn wall(text: &str, more: &[&str]) -> Vec<u8> {
    let folder = Folder::with_study(text);
    let member = if more.contains(&"--member") { &[][..] } else { &["--member", "5"] };
    let generate = ["wall", "studies/tiny", "--arm", "random", "--out", "wall.json"];
    let output = folder.pirca(&[&generate, member, more].concat());
    assert!(output.status.success(), "{}", stderr(&output));
    fs::read(folder.path("wall.json")).unwrap()
}

#[test]
fn another_kn_solver_variant_or_comment_leaves_every_stone_as_it_was() {
    let stones = wall(STUDY, &[]);
    let others = [
        ("another kn", changed("[5e7, 1.75e8]", "[3e7]")),
        (
            "scattered kn",
            changed(
                "kn_over_ks = 2",
                "kn_over_ks = 2\nkn_factor = { family = \"uniform\", low = 0.8, high = 1.2 }",
            ),
        ),
        ("another solver setting", changed("unbalanced_ratio = 1e-4", "unbalanced_ratio = 1e-3")),
        ("another load", changed("mean_pressure_pa = 200", "mean_pressure_pa = 100")),
        ("a comment", format!("# a comment\n{STUDY}")),
        ("another number of members", changed("members = 8", "members = 6")),
    ];
    for (what, text) in others {
        assert!(wall(&text, &[]) == stones, "{what} must leave the stones alone");
    }
    assert!(wall(STUDY, &["--point", "1"]) == stones, "the wall is the same at every kn");
    assert!(wall(STUDY, &["--variant", "slippery"]) == stones, "joints are not stones");
}

/// The comparison above could tell.
#[test]
fn another_seed_or_member_is_another_wall() {
    let stones = wall(STUDY, &[]);
    assert!(wall(STUDY, &["--seed", "8"]) != stones);
    assert!(wall(STUDY, &["--member", "6"]) != stones);
}
