//! Tokens and sessions.

use std::sync::Arc;

use goalgraph_server::store::{NewToken, SessionRow, Store, StoreError};

use super::place::{Place, on_every_database};

on_every_database! {
    tokens_are_kept_until_they_are_revoked_and_listed_after,
    sessions_end_when_they_expire_or_their_token_is_revoked,
}

async fn create(store: &Store, id: &str, created_at_ms: i64) {
    let new = NewToken {
        id: id.to_owned(),
        name: format!("for {id}"),
        role: "editor".to_owned(),
        hash: "$argon2id$x".to_owned(),
        created_at_ms,
    };
    store.create_token(new).await.unwrap();
}

async fn tokens_are_kept_until_they_are_revoked_and_listed_after(place: Arc<Place>) {
    let store = place.open().await;
    create(&store, "b", 20).await;
    create(&store, "a", 10).await;
    let first = store.token("b").await.unwrap();
    assert_eq!((first.name.as_str(), first.role.as_str(), first.revoked_at_ms), ("for b", "editor", None));
    store.revoke_token("b", 30).await.unwrap();
    store.revoke_token("b", 40).await.unwrap();
    let tokens = store.tokens().await.unwrap();
    let seen: Vec<_> = tokens.iter().map(|it| (it.id.as_str(), it.revoked_at_ms)).collect();
    assert_eq!(seen, [("b", Some(30)), ("a", None)]);
    assert_eq!(store.revoke_token("c", 1).await.unwrap_err().to_string(), "there is no token c");
    assert!(matches!(store.token("c").await, Err(StoreError::NotFound { .. })));
}

async fn sessions_end_when_they_expire_or_their_token_is_revoked(place: Arc<Place>) {
    let store = place.open().await;
    create(&store, "a", 1).await;
    create(&store, "b", 1).await;
    for (hash, token, expires_at_ms) in [("1", "a", 100), ("2", "a", 200), ("3", "b", 200), ("4", "b", 300)] {
        store.create_session(hash, token, expires_at_ms).await.unwrap();
    }
    assert!(store.create_session("5", "nobody", 1).await.is_err());
    let found = store.session("2").await.unwrap();
    assert_eq!(found, Some(SessionRow { token: "a".to_owned(), expires_at_ms: 200 }));
    assert_eq!(store.delete_expired_sessions(100).await.unwrap(), 1);
    store.revoke_token("a", 1).await.unwrap();
    store.delete_session("3").await.unwrap();
    store.delete_session("3").await.unwrap();
    let mut left = Vec::new();
    for hash in ["1", "2", "3", "4", "5"] {
        left.extend(store.session(hash).await.unwrap().map(|_| hash));
    }
    assert_eq!(left, ["4"]);
}
