-- Who may do what. Neither tokens nor session ids are kept, only their hashes.

CREATE TABLE tokens (
    id TEXT NOT NULL PRIMARY KEY,
    sequence BIGINT NOT NULL UNIQUE,
    name TEXT NOT NULL,
    role TEXT NOT NULL,
    hash TEXT NOT NULL,
    created_at_ms BIGINT NOT NULL,
    revoked_at_ms BIGINT
);

CREATE TABLE sessions (
    hash TEXT NOT NULL PRIMARY KEY,
    token TEXT NOT NULL REFERENCES tokens (id),
    expires_at_ms BIGINT NOT NULL
);
