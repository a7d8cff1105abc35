//! The app's worker.

fn main() {
    goalgraph_web::worker::start();
}
