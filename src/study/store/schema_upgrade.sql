-- Copies the results of schemas 4 and 5, attached as `old`. store_upgrade.c adds the revisions that made them.

INSERT INTO series SELECT id, kind, scene, scene_hash, options, pattern, n, dim, width, height, what, '', '', ''
  FROM old.series;
INSERT INTO result SELECT * FROM old.result;
