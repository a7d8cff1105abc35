-- One set of tables for SQLite and PostgreSQL. Times are milliseconds since 1970 and order nothing: clocks go backwards.
-- What has an order has a number from `counters`, given in the transaction that writes it.

CREATE TABLE counters (
    name TEXT NOT NULL PRIMARY KEY,
    value BIGINT NOT NULL
);

INSERT INTO counters (name, value) VALUES ('sequence', 0);

-- `head` is the newest revision, `approved` the approved one or 0,
-- `deleted` is 1 for one that is hidden.
CREATE TABLE specifications (
    id TEXT NOT NULL PRIMARY KEY,
    head BIGINT NOT NULL,
    approved BIGINT NOT NULL,
    saved_sequence BIGINT NOT NULL UNIQUE,
    created_at_ms BIGINT NOT NULL,
    deleted BIGINT NOT NULL
);

CREATE TABLE revisions (
    specification TEXT NOT NULL REFERENCES specifications (id),
    number BIGINT NOT NULL,
    name TEXT NOT NULL,
    sha256 TEXT NOT NULL,
    content TEXT NOT NULL,
    positions TEXT,
    author TEXT NOT NULL,
    message TEXT NOT NULL,
    saved_at_ms BIGINT NOT NULL,
    PRIMARY KEY (specification, number)
);

-- The journal of approvals; `kind` is 'approved' or 'revoked'. Rows are only ever added.
CREATE TABLE approvals (
    sequence BIGINT NOT NULL PRIMARY KEY,
    specification TEXT NOT NULL,
    revision BIGINT NOT NULL,
    kind TEXT NOT NULL,
    sha256 TEXT NOT NULL,
    who TEXT NOT NULL,
    token TEXT,
    meaning TEXT NOT NULL,
    comment TEXT NOT NULL,
    at_ms BIGINT NOT NULL,
    FOREIGN KEY (specification, revision) REFERENCES revisions (specification, number)
);

CREATE INDEX approvals_of_a_specification ON approvals (specification, sequence);

-- The files themselves lie beside the database, under their SHA-256.
CREATE TABLE demonstrations (
    sha256 TEXT NOT NULL PRIMARY KEY,
    bytes BIGINT NOT NULL,
    name TEXT NOT NULL,
    media_type TEXT NOT NULL,
    added_at_ms BIGINT NOT NULL
);

CREATE TABLE specification_demonstrations (
    specification TEXT NOT NULL REFERENCES specifications (id),
    sha256 TEXT NOT NULL REFERENCES demonstrations (sha256),
    name TEXT NOT NULL,
    sequence BIGINT NOT NULL,
    PRIMARY KEY (specification, sha256)
);
