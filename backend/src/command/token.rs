//! `goalgraph token`: who may use the server from other computers.

use clap::builder::{PossibleValue, PossibleValuesParser, TypedValueParser};
use clap::{Args, Subcommand};
use goalgraph::protocol::api::Role;
use goalgraph_server::store::{NewToken, Store, StoreOptions, TokenRow};
use goalgraph_server::token::{Token, TokenError};
use jiff::Timestamp;

use super::store_arguments::StoreArguments;
use crate::failure::Failure;
use crate::output;

/// Arguments of `goalgraph token`.
#[derive(Args)]
pub(crate) struct Arguments {
    #[command(subcommand)]
    action: Action,
}

#[derive(Subcommand)]
enum Action {
    /// Makes a token and prints it; it cannot be printed again
    Create {
        /// What it is for, or for whom
        #[arg(value_name = "NAME")]
        name: String,
        /// What it allows
        #[arg(long, value_parser = role_parser())]
        role: Role,
        #[command(flatten)]
        store: StoreArguments,
    },
    /// Lists the tokens: id, role, when they were made, name
    List {
        #[command(flatten)]
        store: StoreArguments,
    },
    /// Makes a token worthless and ends its sessions
    Revoke {
        /// The token's id, the part between its two underscores
        #[arg(value_name = "ID")]
        id: String,
        #[command(flatten)]
        store: StoreArguments,
    },
}

fn role_parser() -> impl TypedValueParser<Value = Role> {
    let value = |role: Role| {
        PossibleValue::new(role.name()).help(match role {
            Role::Viewer => "look at everything",
            Role::Editor => "look and save",
            Role::Approver => "look, save and approve",
            Role::Executor => "be an executor, nothing else",
        })
    };
    PossibleValuesParser::new(Role::ALL.map(value)).try_map(|name: String| name.parse::<Role>())
}

/// Does what is asked for.
///
/// # Errors
///
/// When the store cannot be opened, or there is no such token.
pub(crate) fn run(arguments: &Arguments) -> Result<(), Failure> {
    match &arguments.action {
        Action::Create { name, role, store } => create(name, *role, store),
        Action::List { store } => list(store),
        Action::Revoke { id, store } => revoke(id, store),
    }
}

fn create(name: &str, role: Role, arguments: &StoreArguments) -> Result<(), Failure> {
    let failure = |error: TokenError| Failure::input(error.to_string());
    let token = Token::generate().map_err(failure)?;
    let new = NewToken {
        id: token.id().to_owned(),
        name: name.to_owned(),
        role: role.name().to_owned(),
        hash: token.hash().map_err(failure)?,
        created_at_ms: Timestamp::now().as_millisecond(),
    };
    let keep = |store: Store| async move { store.create_token(new).await };
    arguments.with_store(StoreOptions::default(), keep)?;
    output::print(&format!("{}\n", token.reveal()))?;
    output::say("Keep it now: only its hash is stored, so it cannot be shown again.");
    Ok(())
}

fn list(arguments: &StoreArguments) -> Result<(), Failure> {
    let tokens = arguments.with_store(existing(), |store: Store| async move { store.tokens().await })?;
    let lines: String = tokens.iter().map(line).collect();
    output::print(&lines)
}

fn revoke(id: &str, arguments: &StoreArguments) -> Result<(), Failure> {
    let now_ms = Timestamp::now().as_millisecond();
    arguments.with_store(existing(), |store: Store| async move { store.revoke_token(id, now_ms).await })?;
    output::say(&format!("The token {id} is worthless now."));
    Ok(())
}

fn existing() -> StoreOptions {
    StoreOptions { create: false, ..StoreOptions::default() }
}

fn line(token: &TokenRow) -> String {
    let day =
        |at_ms| Timestamp::from_millisecond(at_ms).map_or_else(|_| at_ms.to_string(), |it| it.to_string());
    let revoked = token.revoked_at_ms.map_or_else(String::new, |at_ms| format!("  (revoked {})", day(at_ms)));
    // A name is one field of one line, whatever it is made of.
    let name: String = token.name.chars().map(|it| if it.is_control() { ' ' } else { it }).collect();
    format!("{}  {:<8}  {}  {name}{revoked}\n", token.id, token.role, day(token.created_at_ms))
}
