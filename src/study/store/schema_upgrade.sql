-- From schemas 4 and 5, attached as `old`: the same results. What made them is put in by store_upgrade.c.

INSERT INTO series SELECT id, kind, scene, scene_hash, options, pattern, n, dim, width, height, what, '', ''
  FROM old.series;
INSERT INTO result SELECT * FROM old.result;
