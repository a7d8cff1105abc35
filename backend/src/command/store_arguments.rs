//! stub
use crate::failure::Failure;
use clap::Args;
use goalgraph_server::store::Location;
use std::path::PathBuf;
#[derive(Args)]
pub(crate) struct StoreArguments {
    #[arg(long, value_name = "DIR")]
    data: Option<PathBuf>,
    #[arg(long)]
    database: Option<String>,
}
impl StoreArguments {
    pub(crate) fn location(&self) -> Result<Location, Failure> {
        Ok(Location {
            data: self.data.clone().unwrap_or_else(|| PathBuf::from("/tmp/gg-data")),
            database: self.database.clone(),
        })
    }
    pub(crate) fn as_typed(&self) -> String {
        String::new()
    }
}
