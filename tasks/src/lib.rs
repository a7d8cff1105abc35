//! Seeded tasks.
