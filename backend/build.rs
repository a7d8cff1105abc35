//! Has the crate compiled again when a file that it embeds comes, goes or changes.

fn main() {
    for path in ["build.rs", "migrations", "../dist", "../assets/samples"] {
        println!("cargo::rerun-if-changed={path}");
    }
}
