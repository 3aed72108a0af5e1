-- Copies the results of schema 3, attached as `old`, which had a row for each series and trial; new rows hold four.

CREATE TEMP TABLE number AS -- new ids of series: measures of the same point sets get consecutive ids
  WITH placed AS (
    SELECT *, kind = 'image' AS image, CASE kind WHEN 'image' THEN what END AS own,
           row_number() OVER (PARTITION BY kind, scene, scene_hash, options, pattern, n, dim, width, height,
                              CASE kind WHEN 'image' THEN what END ORDER BY id) - 1 AS place
    FROM old.series)
  SELECT id AS old, image, place % 4 AS place, 4 * dense_rank() OVER (
           ORDER BY kind, scene, scene_hash, options, pattern, n, dim, width, height, own, place / 4) AS first
  FROM placed;
CREATE UNIQUE INDEX temp.number_by_old ON number (old);

INSERT INTO main.series
  SELECT first + place, kind, scene, scene_hash, options, pattern, n, dim, width, height, what, '', '', ''
  FROM old.series JOIN number ON old = id;

INSERT INTO main.result
  SELECT (id >> 32 << 32) + first, seed,
         max(CASE place WHEN 0 THEN value END),
         max(CASE WHEN image THEN sd WHEN place = 1 THEN value END),
         max(CASE WHEN image THEN max WHEN place = 2 THEN value END),
         max(CASE WHEN image THEN rmse WHEN place = 3 THEN value END)
  FROM old.result JOIN number ON number.old = id & 4294967295
  GROUP BY 1;

DROP TABLE number;
