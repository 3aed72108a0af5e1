-- Copies the results of schema 6, attached as `old`. It had no metrics, which are therefore not measured.

INSERT INTO series SELECT id, kind, scene, scene_hash, options, pattern, n, dim, width, height, what, '', made_by,
  measured_by FROM old.series;
INSERT INTO result SELECT * FROM old.result;
INSERT INTO reference SELECT * FROM old.reference;
