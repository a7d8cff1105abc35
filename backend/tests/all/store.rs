//! The store, on real databases: each test runs on SQLite and on PostgreSQL.

mod access;
mod approvals;
mod backups;
mod commands;
mod demonstrations;
mod faults;
mod kill;
mod place;
mod runs;
mod specifications;
mod versions;
