//! The app in the page.

fn main() {
    goalgraph_web::page::start();
}
