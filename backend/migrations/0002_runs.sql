-- What executors report of the approved revisions that they run.

-- `last_event` is the number of the newest event, 0 without one; `is_open` is 1 until the run has ended.
CREATE TABLE runs (
    id TEXT NOT NULL PRIMARY KEY,
    sequence BIGINT NOT NULL UNIQUE,
    executor TEXT NOT NULL,
    specification TEXT NOT NULL,
    revision BIGINT NOT NULL,
    sha256 TEXT NOT NULL,
    state TEXT NOT NULL,
    is_open BIGINT NOT NULL,
    began_at_ms BIGINT NOT NULL,
    changed_at_ms BIGINT NOT NULL,
    summary TEXT,
    last_event BIGINT NOT NULL,
    FOREIGN KEY (specification, revision) REFERENCES revisions (specification, number)
);

CREATE INDEX runs_of_a_specification ON runs (specification, sequence);

CREATE TABLE run_events (
    run TEXT NOT NULL REFERENCES runs (id),
    number BIGINT NOT NULL,
    event TEXT NOT NULL,
    robot_at_ms BIGINT,
    received_at_ms BIGINT NOT NULL,
    PRIMARY KEY (run, number)
);
