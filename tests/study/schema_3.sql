BEGIN TRANSACTION;
CREATE TABLE meta (key TEXT PRIMARY KEY, value TEXT NOT NULL) WITHOUT ROWID;
INSERT INTO "meta" VALUES('plan','upgrade');
INSERT INTO "meta" VALUES('plan-text-0','{
  "name": "upgrade",
  "title": "Two of everything, and six measures, which are more than a row has",
  "discrepancies": [
    {"patterns": ["random", "zaremba"], "n": [4, 9], "trials": 3,
     "measures": ["star", "l2-star", "extreme", "l2-periodic", "l2-centered", "edge"]},
    {"patterns": ["random"], "n": [4], "trials": 2, "measures": ["l2-star", "diaphony"]},
    {"patterns": ["random"], "n": [4], "trials": 2, "warps": ["polar-disk"], "measures": ["l2-edge", "edge"]}
  ],
  "images": [
    {"scenes": ["checker"], "patterns": ["random", "n-rooks"], "spp": [1], "size": [8, 6], "trials": 3,
     "references": [{"name": "a", "pattern": "regular", "spp": 4}, {"name": "b", "pattern": "jittered", "spp": 16}]}
  ]
}
');
INSERT INTO "meta" VALUES('plan-texts','1 2 0');
INSERT INTO "meta" VALUES('schema','3');
INSERT INTO "meta" VALUES('version','0.1.0');
CREATE TABLE reference (     -- how good a reference image is
  scene TEXT NOT NULL,
  scene_hash TEXT NOT NULL,
  options TEXT NOT NULL,
  width INTEGER NOT NULL,
  height INTEGER NOT NULL,
  reference TEXT NOT NULL,
  standard_error REAL,                     -- mean over the pixels of the reference's own expected absolute error
  PRIMARY KEY (scene, scene_hash, options, width, height, reference)
) WITHOUT ROWID;
INSERT INTO "reference" VALUES('checker','81616f61362ba56d','',8,6,'a:regular@4x1',NULL);
INSERT INTO "reference" VALUES('checker','81616f61362ba56d','',8,6,'b:jittered@16x1',NULL);
CREATE TABLE result (        -- one measure of one point set, or one render compared with one reference
  id INTEGER PRIMARY KEY,                  -- 2^32 trial + series: rows are appended as they are made
  seed INTEGER NOT NULL,                   -- of koksma_generate or koksma_render, as a signed 64-bit number
  value REAL NOT NULL,                     -- the measure, or the mean of the absolute error in luminance over the pixels
  sd REAL,                                 -- of an image: of the absolute error over the pixels
  max REAL,
  rmse REAL
);
INSERT INTO "result" VALUES(1,2255228669148135675,4.7399046018137658276e-01,NULL,NULL,NULL);
INSERT INTO "result" VALUES(2,2255228669148135675,1.16886840736247096805e-01,NULL,NULL,NULL);
INSERT INTO "result" VALUES(3,2255228669148135675,6.37401865042645399128e-01,NULL,NULL,NULL);
INSERT INTO "result" VALUES(4,2255228669148135675,0.170338649900576,NULL,NULL,NULL);
INSERT INTO "result" VALUES(5,2255228669148135675,2.74548405303597475857e-01,NULL,NULL,NULL);
INSERT INTO "result" VALUES(6,2255228669148135675,4.86066539443155809507e-01,NULL,NULL,NULL);
INSERT INTO "result" VALUES(7,-1064183631919901118,3.25160393706663386481e-01,NULL,NULL,NULL);
INSERT INTO "result" VALUES(8,-1064183631919901118,1.00423860359828379107e-01,NULL,NULL,NULL);
INSERT INTO "result" VALUES(9,-1064183631919901118,5.11160726761024086783e-01,NULL,NULL,NULL);
INSERT INTO "result" VALUES(10,-1064183631919901118,1.03022501267966679061e-01,NULL,NULL,NULL);
INSERT INTO "result" VALUES(11,-1064183631919901118,1.98132266069838969269e-01,NULL,NULL,NULL);
INSERT INTO "result" VALUES(12,-1064183631919901118,4.31907361025428149226e-01,NULL,NULL,NULL);
INSERT INTO "result" VALUES(13,2255228669148135675,1.85719828050101143368e+00,NULL,NULL,NULL);
INSERT INTO "result" VALUES(14,2255228669148135675,1.58834286029396670736e-01,NULL,NULL,NULL);
INSERT INTO "result" VALUES(15,2255228669148135675,5.26376254063528614679e-01,NULL,NULL,NULL);
INSERT INTO "result" VALUES(16,3245848494940349372,0.375,NULL,NULL,NULL);
INSERT INTO "result" VALUES(17,3245848494940349372,1.36414592226133307706e-01,NULL,NULL,NULL);
INSERT INTO "result" VALUES(18,3245848494940349372,0.5625,NULL,NULL,NULL);
INSERT INTO "result" VALUES(19,3245848494940349372,1.21923957403329424886e-01,NULL,NULL,NULL);
INSERT INTO "result" VALUES(20,3245848494940349372,1.87355268214634856915e-01,NULL,NULL,NULL);
INSERT INTO "result" VALUES(21,3245848494940349372,3.88888888888888950567e-01,NULL,NULL,NULL);
INSERT INTO "result" VALUES(22,-322168965429322076,1.85185185185185230416e-01,NULL,NULL,NULL);
INSERT INTO "result" VALUES(23,-322168965429322076,5.8887663528675367186e-02,NULL,NULL,NULL);
INSERT INTO "result" VALUES(24,-322168965429322076,2.77777777777777790113e-01,NULL,NULL,NULL);
INSERT INTO "result" VALUES(25,-322168965429322076,6.84253064117140846756e-02,NULL,NULL,NULL);
INSERT INTO "result" VALUES(26,-322168965429322076,8.99296369735564926628e-02,NULL,NULL,NULL);
INSERT INTO "result" VALUES(27,-322168965429322076,2.58487654320987803036e-01,NULL,NULL,NULL);
INSERT INTO "result" VALUES(28,-2857474571970030128,3.1640625760580104453e-01,2.17034295323543707789e-01,7.50000022351741790771e-01,3.83688422028467923663e-01);
INSERT INTO "result" VALUES(29,-2857474571970030128,0.342773449451973,1.43574618240996682017e-01,5.62500022351741790771e-01,3.7162791694415564514e-01);
INSERT INTO "result" VALUES(30,-3771951453070745588,3.08593759778887033462e-01,2.00668751254827637531e-01,7.50000022351741790771e-01,3.6810060622694079635e-01);
INSERT INTO "result" VALUES(31,-3771951453070745588,3.46679701314618171625e-01,1.31103291733937449281e-01,5.62500022351741790771e-01,3.70641185524580918375e-01);
INSERT INTO "result" VALUES(4294967297,8717044937663138202,7.09604420916275402397e-01,NULL,NULL,NULL);
INSERT INTO "result" VALUES(4294967298,8717044937663138202,2.39843061320929223922e-01,NULL,NULL,NULL);
INSERT INTO "result" VALUES(4294967299,8717044937663138202,9.04865647471704059867e-01,NULL,NULL,NULL);
INSERT INTO "result" VALUES(4294967300,8717044937663138202,2.26368877714931138189e-01,NULL,NULL,NULL);
INSERT INTO "result" VALUES(4294967301,8717044937663138202,5.54256155345078660445e-01,NULL,NULL,NULL);
INSERT INTO "result" VALUES(4294967302,8717044937663138202,9.11022352139966296036e-01,NULL,NULL,NULL);
INSERT INTO "result" VALUES(4294967303,-1328889033571449421,0.375973324434658,NULL,NULL,NULL);
INSERT INTO "result" VALUES(4294967304,-1328889033571449421,1.17047282239788150159e-01,NULL,NULL,NULL);
INSERT INTO "result" VALUES(4294967305,-1328889033571449421,4.62226778644677427365e-01,NULL,NULL,NULL);
INSERT INTO "result" VALUES(4294967306,-1328889033571449421,1.00990797239170093657e-01,NULL,NULL,NULL);
INSERT INTO "result" VALUES(4294967307,-1328889033571449421,1.71420245658130437904e-01,NULL,NULL,NULL);
INSERT INTO "result" VALUES(4294967308,-1328889033571449421,3.96382348058930189527e-01,NULL,NULL,NULL);
INSERT INTO "result" VALUES(4294967309,8717044937663138202,2.43505660797336,NULL,NULL,NULL);
INSERT INTO "result" VALUES(4294967310,8717044937663138202,2.53026791351666557883e-01,NULL,NULL,NULL);
INSERT INTO "result" VALUES(4294967311,8717044937663138202,0.725338246421826,NULL,NULL,NULL);
INSERT INTO "result" VALUES(4294967324,2026646812289756804,3.55468760865430055684e-01,2.17315337449304729622e-01,7.50000022351741790771e-01,4.1663412707303448812e-01);
INSERT INTO "result" VALUES(4294967325,2026646812289756804,3.34960948986311735087e-01,1.3361074074024673064e-01,5.62500022351741790771e-01,0.360625383725228);
INSERT INTO "result" VALUES(4294967326,-1114872093067724924,3.24218759158005298548e-01,1.97912391536372356259e-01,7.50000022351741790771e-01,3.79851442689906115823e-01);
INSERT INTO "result" VALUES(4294967327,-1114872093067724924,3.56445326935499906539e-01,1.27204531910792201232e-01,5.62500022351741790771e-01,3.78463028620761310349e-01);
CREATE TABLE run (           -- when, where and how long somebody worked on this file
  id INTEGER PRIMARY KEY,
  started TEXT NOT NULL,                   -- UTC
  machine TEXT NOT NULL,
  version TEXT NOT NULL,
  workers INTEGER NOT NULL,                -- threads, or MPI ranks
  jobs INTEGER NOT NULL,                   -- done in this run
  seconds REAL NOT NULL,
  idle_seconds REAL NOT NULL,              -- of all workers together, without a job in hand
  processor_seconds REAL NOT NULL,         -- of all threads and ranks
  store_seconds REAL NOT NULL              -- of processor_seconds, in this database
);
INSERT INTO "run" VALUES(1,'2026-11-21T14:02:17Z','AMD EPYC, Linux x86_64','0.1.0',2,14,2.89665300078922882676e-03,2.25639700157845768044e-03,3.63382400000000077566e-03,5.91643999999994798198e-04);
CREATE TABLE series (        -- what is measured, all but the trial: one row a mean in a table
  id INTEGER PRIMARY KEY,
  kind TEXT NOT NULL,                      -- 'discrepancy' or 'image'
  scene TEXT NOT NULL,                     -- '' for discrepancies, as the next
  scene_hash TEXT NOT NULL,                -- of the scene's text, hexadecimal
  options TEXT NOT NULL,                   -- what differs from the defaults: pairing=aligned, warp=polar-disk
  pattern TEXT NOT NULL,                   -- canonical spec, e.g. poisson-disk:d=0.2
  n INTEGER NOT NULL,                      -- points, or samples a pixel
  dim INTEGER NOT NULL,                    -- 0 for images
  width INTEGER NOT NULL,                  -- 0 for discrepancies, as the next
  height INTEGER NOT NULL,
  what TEXT NOT NULL,                      -- the measure's canonical spec, or the reference: name:pattern@spp x replicates
  UNIQUE (kind, scene, scene_hash, options, pattern, n, dim, width, height, what)
);
INSERT INTO "series" VALUES(1,'discrepancy','','','','random',4,2,0,0,'star');
INSERT INTO "series" VALUES(2,'discrepancy','','','','random',4,2,0,0,'l2-star');
INSERT INTO "series" VALUES(3,'discrepancy','','','','random',4,2,0,0,'extreme');
INSERT INTO "series" VALUES(4,'discrepancy','','','','random',4,2,0,0,'l2-periodic');
INSERT INTO "series" VALUES(5,'discrepancy','','','','random',4,2,0,0,'l2-centered');
INSERT INTO "series" VALUES(6,'discrepancy','','','','random',4,2,0,0,'edge');
INSERT INTO "series" VALUES(7,'discrepancy','','','','random',9,2,0,0,'star');
INSERT INTO "series" VALUES(8,'discrepancy','','','','random',9,2,0,0,'l2-star');
INSERT INTO "series" VALUES(9,'discrepancy','','','','random',9,2,0,0,'extreme');
INSERT INTO "series" VALUES(10,'discrepancy','','','','random',9,2,0,0,'l2-periodic');
INSERT INTO "series" VALUES(11,'discrepancy','','','','random',9,2,0,0,'l2-centered');
INSERT INTO "series" VALUES(12,'discrepancy','','','','random',9,2,0,0,'edge');
INSERT INTO "series" VALUES(13,'discrepancy','','','','random',4,2,0,0,'diaphony');
INSERT INTO "series" VALUES(14,'discrepancy','','','polar-disk','random',4,2,0,0,'l2-edge');
INSERT INTO "series" VALUES(15,'discrepancy','','','polar-disk','random',4,2,0,0,'edge');
INSERT INTO "series" VALUES(16,'discrepancy','','','','zaremba',4,2,0,0,'star');
INSERT INTO "series" VALUES(17,'discrepancy','','','','zaremba',4,2,0,0,'l2-star');
INSERT INTO "series" VALUES(18,'discrepancy','','','','zaremba',4,2,0,0,'extreme');
INSERT INTO "series" VALUES(19,'discrepancy','','','','zaremba',4,2,0,0,'l2-periodic');
INSERT INTO "series" VALUES(20,'discrepancy','','','','zaremba',4,2,0,0,'l2-centered');
INSERT INTO "series" VALUES(21,'discrepancy','','','','zaremba',4,2,0,0,'edge');
INSERT INTO "series" VALUES(22,'discrepancy','','','','zaremba',9,2,0,0,'star');
INSERT INTO "series" VALUES(23,'discrepancy','','','','zaremba',9,2,0,0,'l2-star');
INSERT INTO "series" VALUES(24,'discrepancy','','','','zaremba',9,2,0,0,'extreme');
INSERT INTO "series" VALUES(25,'discrepancy','','','','zaremba',9,2,0,0,'l2-periodic');
INSERT INTO "series" VALUES(26,'discrepancy','','','','zaremba',9,2,0,0,'l2-centered');
INSERT INTO "series" VALUES(27,'discrepancy','','','','zaremba',9,2,0,0,'edge');
INSERT INTO "series" VALUES(28,'image','checker','81616f61362ba56d','','random',1,0,8,6,'a:regular@4x1');
INSERT INTO "series" VALUES(29,'image','checker','81616f61362ba56d','','random',1,0,8,6,'b:jittered@16x1');
INSERT INTO "series" VALUES(30,'image','checker','81616f61362ba56d','','n-rooks',1,0,8,6,'a:regular@4x1');
INSERT INTO "series" VALUES(31,'image','checker','81616f61362ba56d','','n-rooks',1,0,8,6,'b:jittered@16x1');
CREATE VIEW rows AS
  SELECT kind, scene, scene_hash, options, pattern, n, dim, width, height, what, result.id >> 32 AS trial, seed, value,
         sd, max, rmse
  FROM result JOIN series ON series.id = result.id & 4294967295;
COMMIT;
