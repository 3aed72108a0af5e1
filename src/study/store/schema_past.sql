-- All statements of schemas 3, 4 and 5, each listed once. A store with no other statements, whose table meta has the
-- number of its schema, is upgraded in a copy (store_upgrade.c).

CREATE TABLE meta ( key TEXT PRIMARY KEY, value TEXT NOT NULL ) WITHOUT ROWID;
CREATE TABLE meta (key TEXT PRIMARY KEY, value TEXT NOT NULL) WITHOUT ROWID;
CREATE TABLE series ( id INTEGER PRIMARY KEY, kind TEXT NOT NULL, scene TEXT NOT NULL, scene_hash TEXT NOT NULL,
  options TEXT NOT NULL, pattern TEXT NOT NULL, n INTEGER NOT NULL, dim INTEGER NOT NULL, width INTEGER NOT NULL, height
  INTEGER NOT NULL, what TEXT NOT NULL, UNIQUE (kind, scene, scene_hash, options, pattern, n, dim, width, height, what)
  );
CREATE TABLE result ( id INTEGER PRIMARY KEY, seed INTEGER NOT NULL, value REAL NOT NULL, sd REAL, max REAL, rmse REAL
  );
CREATE TABLE reference ( scene TEXT NOT NULL, scene_hash TEXT NOT NULL, options TEXT NOT NULL, width INTEGER NOT NULL,
  height INTEGER NOT NULL, reference TEXT NOT NULL, standard_error REAL, PRIMARY KEY (scene, scene_hash, options, width,
  height, reference) ) WITHOUT ROWID;
CREATE TABLE run ( id INTEGER PRIMARY KEY, started TEXT NOT NULL, machine TEXT NOT NULL, version TEXT NOT NULL,
  workers INTEGER NOT NULL, jobs INTEGER NOT NULL, seconds REAL NOT NULL, idle_seconds REAL NOT NULL, processor_seconds
  REAL NOT NULL, store_seconds REAL NOT NULL );
CREATE VIEW rows AS SELECT kind, scene, scene_hash, options, pattern, n, dim, width, height, what, result.id >> 32 AS
  trial, seed, value, sd, max, rmse FROM result JOIN series ON series.id = result.id & 4294967295;
CREATE TABLE result ( id INTEGER PRIMARY KEY, seed INTEGER NOT NULL, v0 REAL, v1 REAL, v2 REAL, v3 REAL );
CREATE VIEW rows AS SELECT kind, scene, scene_hash, options, pattern, n, dim, width, height, what, result.id >> 32 AS
  trial, seed, CASE series.id & 3 WHEN 0 THEN v0 WHEN 1 THEN v1 WHEN 2 THEN v2 ELSE v3 END AS value, CASE kind WHEN
  'image' THEN v1 END AS sd, CASE kind WHEN 'image' THEN v2 END AS max, CASE kind WHEN 'image' THEN v3 END AS rmse FROM
  result JOIN series ON series.id BETWEEN result.id & 4294967295 AND (result.id & 4294967295) + 3 WHERE value IS NOT
  NULL;
CREATE VIEW rows AS SELECT kind, scene, scene_hash, options, pattern, n, dim, width, height, what, result.id >> 32 AS
  trial, seed, CASE series.id & 3 WHEN 0 THEN v0 WHEN 1 THEN v1 WHEN 2 THEN v2 ELSE v3 END AS value, CASE kind WHEN
  'image' THEN v1 END AS sd, CASE kind WHEN 'image' THEN v2 END AS max, CASE kind WHEN 'image' THEN v3 END AS rmse, CASE
  kind WHEN 'coherence' THEN v1 END AS p, CASE kind WHEN 'coherence' THEN v2 END AS frequency_x, CASE kind WHEN
  'coherence' THEN v3 END AS frequency_y FROM result JOIN series ON series.id BETWEEN result.id & 4294967295 AND
  (result.id & 4294967295) + 3 WHERE value IS NOT NULL;
