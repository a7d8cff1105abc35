//! Small changes to a layout: what stays, what moves, and how it looks.

#![allow(clippy::unwrap_used, reason = "a test may fail by panicking")]

mod adjust {
    mod any_edit;
    mod boxes;
    mod edges;
    mod scene;
}
