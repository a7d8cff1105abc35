//! A simulated robot at a server: for trying the relay, and as a model for executors of real robots.
//!
//! Modules in reading order: [`robot`] moves, [`disturbance`] says what goes wrong and when; a [`work`] is one run; the
//! [`session`] says what is to be said to the server and knows no socket; the [`connection`] is the socket, made again by
//! [`backoff`] when it is lost; [`lines`](self) tells people about it.

mod backoff;
mod connection;
mod disturbance;
mod lines;
mod robot;
mod session;
mod work;

pub use connection::{Address, ConnectionError, run};
pub use disturbance::{Disturbances, Timed};
pub use robot::Robot;
pub use session::{Begin, Session, Settings};
