//! The relay over real sockets and a real database in a temporary folder.

mod bench;
mod client;

mod approvals;
mod commands;
mod faults;
mod floods;
mod leases;
mod monitors;
mod names;
mod restarts;
mod runs;
mod slow;
mod transcript;
