BEGIN TRANSACTION;
CREATE TABLE account (
	id INTEGER NOT NULL, 
	person INTEGER NOT NULL, 
	password TEXT, 
	active BOOLEAN NOT NULL, 
	changed_at BIGINT NOT NULL, 
	CONSTRAINT pk_account PRIMARY KEY (id), 
	CONSTRAINT fk_account_person_person FOREIGN KEY(person) REFERENCES person (id), 
	CONSTRAINT uq_account_person UNIQUE (person)
);
INSERT INTO "account" VALUES(1,1,'account.password',1,1772438400000000);
CREATE TABLE alarm (
	id INTEGER NOT NULL, 
	series INTEGER, 
	instrument INTEGER, 
	held_by INTEGER, 
	opened_at BIGINT NOT NULL, 
	CONSTRAINT pk_alarm PRIMARY KEY (id), 
	CONSTRAINT fk_alarm_held_by_alarm FOREIGN KEY(held_by) REFERENCES alarm (id), 
	CONSTRAINT fk_alarm_instrument_instrument FOREIGN KEY(instrument) REFERENCES instrument (id), 
	CONSTRAINT fk_alarm_series_series FOREIGN KEY(series) REFERENCES series (id)
);
INSERT INTO "alarm" VALUES(1,1,1,1,1772438400000000);
CREATE TABLE alarm_step (
	id INTEGER NOT NULL, 
	alarm INTEGER NOT NULL, 
	state TEXT NOT NULL, 
	at BIGINT NOT NULL, 
	test INTEGER, 
	facts TEXT NOT NULL, 
	who TEXT DEFAULT '' NOT NULL, 
	why TEXT DEFAULT '' NOT NULL, 
	CONSTRAINT pk_alarm_step PRIMARY KEY (id), 
	CONSTRAINT ck_alarm_step_state CHECK (state IN ('open', 'worse', 'held', 'released', 'acknowledged', 'closed as repaired', 'closed as false')), 
	CONSTRAINT fk_alarm_step_alarm_alarm FOREIGN KEY(alarm) REFERENCES alarm (id), 
	CONSTRAINT fk_alarm_step_test_test FOREIGN KEY(test) REFERENCES test (id)
);
INSERT INTO "alarm_step" VALUES(1,1,'open',1772438400000000,1,'{"x":[1.5,null,"µ"]}','alarm_step.who','alarm_step.why');
CREATE TABLE analysis (
	id INTEGER NOT NULL, 
	test INTEGER NOT NULL, 
	software TEXT NOT NULL, 
	settings TEXT NOT NULL, 
	inputs_sha256 TEXT NOT NULL, 
	made_at BIGINT NOT NULL, 
	supported BOOLEAN NOT NULL, 
	error TEXT, 
	signatures BLOB, 
	document_sha256 TEXT, 
	document BLOB, 
	CONSTRAINT pk_analysis PRIMARY KEY (id), 
	CONSTRAINT fk_analysis_test_test FOREIGN KEY(test) REFERENCES test (id), 
	CONSTRAINT uq_analysis_test_software_inputs_sha256 UNIQUE (test, software, inputs_sha256)
);
INSERT INTO "analysis" VALUES(1,1,'analysis.software','{"x":[1.5,null,"µ"]}','analysis.inputs_sha256',1772438400000000,1,'analysis.error',X'789CAB56AA50B28A36D433D5C92BCDC9D1513AB45529B6160046810709','analysis.document_sha256',X'789CAB56AA50B28A36D433D5C92BCDC9D1513AB45529B6160046810709');
CREATE TABLE audit (
	number INTEGER NOT NULL, 
	at BIGINT NOT NULL, 
	who TEXT NOT NULL, 
	what TEXT NOT NULL, 
	subject TEXT NOT NULL, 
	old TEXT, 
	new TEXT, 
	why TEXT DEFAULT '' NOT NULL, 
	previous TEXT NOT NULL, 
	sha256 TEXT NOT NULL, 
	CONSTRAINT pk_audit PRIMARY KEY (number), 
	CONSTRAINT uq_audit_sha256 UNIQUE (sha256)
);
INSERT INTO "audit" VALUES(1,1772438400000000,'A. Miller','migrate','schema',NULL,'"0002"','elastogeo 0.2.0','0000000000000000000000000000000000000000000000000000000000000000','7a60c2ebb9ce8f5a43f888ca125055fe92ab0c321d42105e2ad5fc99af7dfbbe');
INSERT INTO "audit" VALUES(2,1772442000000000,'A. Miller','set aside','test 1','false','true','ball not seated','7a60c2ebb9ce8f5a43f888ca125055fe92ab0c321d42105e2ad5fc99af7dfbbe','8f9fc87c16ac3740361296a4219f83e7036d58525499a0213a6b3db8825c18fb');
CREATE TABLE audit_head (
	id INTEGER NOT NULL, 
	number INTEGER NOT NULL, 
	sha256 TEXT NOT NULL, 
	CONSTRAINT pk_audit_head PRIMARY KEY (id), 
	CONSTRAINT ck_audit_head_only CHECK (id = 1)
);
INSERT INTO "audit_head" VALUES(1,2,'8f9fc87c16ac3740361296a4219f83e7036d58525499a0213a6b3db8825c18fb');
CREATE TABLE baseline (
	id INTEGER NOT NULL, 
	series INTEGER NOT NULL, 
	tests TEXT NOT NULL, 
	since BIGINT NOT NULL, 
	set_at BIGINT NOT NULL, 
	who TEXT NOT NULL, 
	why TEXT NOT NULL, 
	CONSTRAINT pk_baseline PRIMARY KEY (id), 
	CONSTRAINT fk_baseline_series_series FOREIGN KEY(series) REFERENCES series (id)
);
INSERT INTO "baseline" VALUES(1,1,'{"x":[1.5,null,"µ"]}',1772438400000000,1772438400000000,'baseline.who','baseline.why');
CREATE TABLE blob (
	sha256 TEXT NOT NULL, 
	size INTEGER NOT NULL, 
	made_at BIGINT NOT NULL, 
	CONSTRAINT pk_blob PRIMARY KEY (sha256)
);
INSERT INTO "blob" VALUES('aaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaa',1,1772438400000000);
CREATE TABLE calibration (
	id INTEGER NOT NULL, 
	instrument INTEGER NOT NULL, 
	at BIGINT NOT NULL, 
	due BIGINT, 
	certificate TEXT DEFAULT '' NOT NULL, 
	content TEXT NOT NULL, 
	who TEXT DEFAULT '' NOT NULL, 
	CONSTRAINT pk_calibration PRIMARY KEY (id), 
	CONSTRAINT fk_calibration_instrument_instrument FOREIGN KEY(instrument) REFERENCES instrument (id)
);
INSERT INTO "calibration" VALUES(1,1,1772438400000000,1772438400000000,'calibration.certificate','{"x":[1.5,null,"µ"]}','calibration.who');
CREATE TABLE campaign (
	id INTEGER NOT NULL, 
	machine INTEGER NOT NULL, 
	name TEXT NOT NULL, 
	made_at BIGINT NOT NULL, 
	content TEXT NOT NULL, 
	CONSTRAINT pk_campaign PRIMARY KEY (id), 
	CONSTRAINT fk_campaign_machine_machine FOREIGN KEY(machine) REFERENCES machine (id), 
	CONSTRAINT uq_campaign_machine_name UNIQUE (machine, name)
);
INSERT INTO "campaign" VALUES(1,1,'campaign.name',1772438400000000,'{"x":[1.5,null,"µ"]}');
CREATE TABLE campaign_test (
	id INTEGER NOT NULL, 
	campaign INTEGER NOT NULL, 
	test INTEGER NOT NULL, 
	CONSTRAINT pk_campaign_test PRIMARY KEY (id), 
	CONSTRAINT fk_campaign_test_campaign_campaign FOREIGN KEY(campaign) REFERENCES campaign (id), 
	CONSTRAINT fk_campaign_test_test_test FOREIGN KEY(test) REFERENCES test (id), 
	CONSTRAINT uq_campaign_test_campaign_test UNIQUE (campaign, test)
);
INSERT INTO "campaign_test" VALUES(1,1,1);
CREATE TABLE drawing (
	id INTEGER NOT NULL, 
	analysis INTEGER NOT NULL, 
	software TEXT NOT NULL, 
	made_at BIGINT NOT NULL, 
	content BLOB NOT NULL, 
	CONSTRAINT pk_drawing PRIMARY KEY (id), 
	CONSTRAINT fk_drawing_analysis_analysis FOREIGN KEY(analysis) REFERENCES analysis (id), 
	CONSTRAINT uq_drawing_analysis_software UNIQUE (analysis, software)
);
INSERT INTO "drawing" VALUES(1,1,'drawing.software',1772438400000000,X'789CAB56AA50B28A36D433D5C92BCDC9D1513AB45529B6160046810709');
CREATE TABLE event (
	id INTEGER NOT NULL, 
	machine INTEGER, 
	instrument INTEGER, 
	kind TEXT NOT NULL, 
	at BIGINT NOT NULL, 
	note TEXT NOT NULL, 
	who TEXT NOT NULL, 
	made_at BIGINT NOT NULL, 
	CONSTRAINT pk_event PRIMARY KEY (id), 
	CONSTRAINT ck_event_kind CHECK (kind IN ('repair', 'parameter edit', 'move', 'crash', 'calibration', 'note')), 
	CONSTRAINT fk_event_instrument_instrument FOREIGN KEY(instrument) REFERENCES instrument (id), 
	CONSTRAINT fk_event_machine_machine FOREIGN KEY(machine) REFERENCES machine (id)
);
INSERT INTO "event" VALUES(1,1,1,'repair',1772438400000000,'event.note','event.who',1772438400000000);
CREATE TABLE indicator (
	id INTEGER NOT NULL, 
	analysis INTEGER NOT NULL, 
	name TEXT NOT NULL, 
	kind TEXT NOT NULL, 
	value FLOAT NOT NULL, 
	standard_uncertainty FLOAT, 
	CONSTRAINT pk_indicator PRIMARY KEY (id), 
	CONSTRAINT fk_indicator_analysis_analysis FOREIGN KEY(analysis) REFERENCES analysis (id), 
	CONSTRAINT uq_indicator_analysis_name UNIQUE (analysis, name)
);
INSERT INTO "indicator" VALUES(1,1,'indicator.name','indicator.kind',1.0,1.0);
CREATE TABLE instrument (
	id INTEGER NOT NULL, 
	serial TEXT NOT NULL, 
	kind TEXT DEFAULT '' NOT NULL, 
	made_at BIGINT NOT NULL, 
	CONSTRAINT pk_instrument PRIMARY KEY (id), 
	CONSTRAINT uq_instrument_serial UNIQUE (serial)
);
INSERT INTO "instrument" VALUES(1,'instrument.serial','instrument.kind',1772438400000000);
CREATE TABLE job (
	id INTEGER NOT NULL, 
	kind TEXT NOT NULL, 
	asked TEXT NOT NULL, 
	state TEXT NOT NULL, 
	who TEXT DEFAULT '' NOT NULL, 
	made_at BIGINT NOT NULL, 
	started_at BIGINT, 
	beat_at BIGINT, 
	ended_at BIGINT, 
	worker TEXT DEFAULT '' NOT NULL, 
	tries INTEGER DEFAULT '0' NOT NULL, 
	step TEXT DEFAULT '' NOT NULL, 
	done INTEGER DEFAULT '0' NOT NULL, 
	total INTEGER DEFAULT '0' NOT NULL, 
	result BLOB, 
	error TEXT DEFAULT '' NOT NULL, 
	CONSTRAINT pk_job PRIMARY KEY (id), 
	CONSTRAINT ck_job_state CHECK (state IN ('waiting', 'running', 'done', 'failed', 'cancelled'))
);
INSERT INTO "job" VALUES(1,'job.kind','{"x":[1.5,null,"µ"]}','waiting','job.who',1772438400000000,1772438400000000,1772438400000000,1772438400000000,'job.worker',1,'job.step',1,1,X'789CAB56AA50B28A36D433D5C92BCDC9D1513AB45529B6160046810709','job.error');
CREATE TABLE machine (
	id INTEGER NOT NULL, 
	name TEXT NOT NULL, 
	kind TEXT DEFAULT '' NOT NULL, 
	serial TEXT DEFAULT '' NOT NULL, 
	place TEXT DEFAULT '' NOT NULL, 
	made_at BIGINT NOT NULL, 
	CONSTRAINT pk_machine PRIMARY KEY (id), 
	CONSTRAINT uq_machine_name UNIQUE (name)
);
INSERT INTO "machine" VALUES(1,'machine.name','machine.kind','machine.serial','machine.place',1772438400000000);
CREATE TABLE outbox (
	id INTEGER NOT NULL, 
	step INTEGER, 
	recipient INTEGER NOT NULL, 
	made_at BIGINT NOT NULL, 
	content TEXT NOT NULL, 
	state TEXT NOT NULL, 
	tries INTEGER DEFAULT '0' NOT NULL, 
	next_at BIGINT, 
	sent_at BIGINT, 
	error TEXT DEFAULT '' NOT NULL, 
	CONSTRAINT pk_outbox PRIMARY KEY (id), 
	CONSTRAINT ck_outbox_state CHECK (state IN ('waiting', 'sent', 'given up')), 
	CONSTRAINT fk_outbox_recipient_recipient FOREIGN KEY(recipient) REFERENCES recipient (id), 
	CONSTRAINT fk_outbox_step_alarm_step FOREIGN KEY(step) REFERENCES alarm_step (id), 
	CONSTRAINT uq_outbox_step_recipient UNIQUE (step, recipient)
);
INSERT INTO "outbox" VALUES(1,1,1,1772438400000000,'{"x":[1.5,null,"µ"]}','waiting',1,1772438400000000,1772438400000000,'outbox.error');
CREATE TABLE person (
	id INTEGER NOT NULL, 
	name TEXT NOT NULL, 
	role TEXT NOT NULL, 
	email TEXT DEFAULT '' NOT NULL, 
	made_at BIGINT NOT NULL, 
	CONSTRAINT pk_person PRIMARY KEY (id), 
	CONSTRAINT ck_person_role CHECK (role IN ('reader', 'engineer', 'administrator')), 
	CONSTRAINT uq_person_name UNIQUE (name)
);
INSERT INTO "person" VALUES(1,'person.name','reader','person.email',1772438400000000);
CREATE TABLE "plan" (
	id INTEGER NOT NULL, 
	machine INTEGER NOT NULL, 
	name TEXT NOT NULL, 
	made_at BIGINT NOT NULL, 
	due BIGINT, 
	grace_days FLOAT DEFAULT '7' NOT NULL, 
	done_at BIGINT, 
	document BLOB NOT NULL, 
	CONSTRAINT pk_plan PRIMARY KEY (id), 
	CONSTRAINT fk_plan_machine_machine FOREIGN KEY(machine) REFERENCES machine (id), 
	CONSTRAINT uq_plan_machine_name UNIQUE (machine, name)
);
INSERT INTO "plan" VALUES(1,1,'plan.name',1772438400000000,1772438400000000,1.0,1772438400000000,X'789CAB56AA50B28A36D433D5C92BCDC9D1513AB45529B6160046810709');
CREATE TABLE recipient (
	id INTEGER NOT NULL, 
	channel TEXT NOT NULL, 
	address TEXT NOT NULL, 
	digest BOOLEAN NOT NULL, 
	active BOOLEAN NOT NULL, 
	CONSTRAINT pk_recipient PRIMARY KEY (id), 
	CONSTRAINT uq_recipient_channel_address UNIQUE (channel, address)
);
INSERT INTO "recipient" VALUES(1,'recipient.channel','recipient.address',1,1);
CREATE TABLE schema_version (
	version_num VARCHAR(32) NOT NULL, 
	CONSTRAINT schema_version_pkc PRIMARY KEY (version_num)
);
INSERT INTO "schema_version" VALUES('0002');
CREATE TABLE series (
	id INTEGER NOT NULL, 
	machine INTEGER NOT NULL, 
	name TEXT NOT NULL, 
	recipe TEXT NOT NULL, 
	recipe_sha256 TEXT NOT NULL, 
	software TEXT NOT NULL, 
	interval_days FLOAT, 
	grace_days FLOAT DEFAULT '7' NOT NULL, 
	alpha FLOAT DEFAULT '0.005' NOT NULL, 
	CONSTRAINT pk_series PRIMARY KEY (id), 
	CONSTRAINT fk_series_machine_machine FOREIGN KEY(machine) REFERENCES machine (id), 
	CONSTRAINT uq_series_machine_name UNIQUE (machine, name), 
	CONSTRAINT uq_series_machine_recipe_sha256 UNIQUE (machine, recipe_sha256)
);
INSERT INTO "series" VALUES(1,1,'series.name','{"x":[1.5,null,"µ"]}','series.recipe_sha256','series.software',1.0,1.0,1.0);
CREATE TABLE series_state (
	series INTEGER NOT NULL, 
	version INTEGER NOT NULL, 
	state TEXT NOT NULL, 
	since BIGINT, 
	last_test BIGINT, 
	due BIGINT, 
	verdict BLOB NOT NULL, 
	CONSTRAINT pk_series_state PRIMARY KEY (series), 
	CONSTRAINT fk_series_state_series_series FOREIGN KEY(series) REFERENCES series (id)
);
INSERT INTO "series_state" VALUES(1,1,'open',1772438400000000,1772438400000000,1772438400000000,X'789CAB56AA50B28A36D433D5C92BCDC9D1513AB45529B6160046810709');
CREATE TABLE session (
	id INTEGER NOT NULL, 
	person INTEGER NOT NULL, 
	sha256 TEXT NOT NULL, 
	made_at BIGINT NOT NULL, 
	seen_at BIGINT NOT NULL, 
	ended_at BIGINT, 
	CONSTRAINT pk_session PRIMARY KEY (id), 
	CONSTRAINT fk_session_person_person FOREIGN KEY(person) REFERENCES person (id), 
	CONSTRAINT uq_session_sha256 UNIQUE (sha256)
);
INSERT INTO "session" VALUES(1,1,'aaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaa',1772438400000000,1772438400000000,1772438400000000);
CREATE TABLE set_aside (
	id INTEGER NOT NULL, 
	test INTEGER NOT NULL, 
	aside BOOLEAN NOT NULL, 
	at BIGINT NOT NULL, 
	who TEXT NOT NULL, 
	why TEXT NOT NULL, 
	CONSTRAINT pk_set_aside PRIMARY KEY (id), 
	CONSTRAINT fk_set_aside_test_test FOREIGN KEY(test) REFERENCES test (id)
);
INSERT INTO "set_aside" VALUES(1,1,1,1772438400000000,'set_aside.who','set_aside.why');
CREATE TABLE silence (
	id INTEGER NOT NULL, 
	machine INTEGER NOT NULL, 
	until BIGINT NOT NULL, 
	at BIGINT NOT NULL, 
	who TEXT NOT NULL, 
	why TEXT NOT NULL, 
	CONSTRAINT pk_silence PRIMARY KEY (id), 
	CONSTRAINT fk_silence_machine_machine FOREIGN KEY(machine) REFERENCES machine (id)
);
INSERT INTO "silence" VALUES(1,1,1772438400000000,1772438400000000,'silence.who','silence.why');
CREATE TABLE test (
	id INTEGER NOT NULL, 
	series INTEGER NOT NULL, 
	sha256 TEXT NOT NULL, 
	name TEXT NOT NULL, 
	at BIGINT NOT NULL, 
	zone TEXT DEFAULT '' NOT NULL, 
	imported_at BIGINT NOT NULL, 
	origin TEXT NOT NULL, 
	from_what TEXT DEFAULT '' NOT NULL, 
	temperature FLOAT, 
	instrument INTEGER, 
	repeats INTEGER, 
	who TEXT DEFAULT '' NOT NULL, 
	about TEXT NOT NULL, 
	CONSTRAINT pk_test PRIMARY KEY (id), 
	CONSTRAINT ck_test_origin CHECK (origin IN ('measured', 'simulated', 'reconstructed')), 
	CONSTRAINT fk_test_instrument_instrument FOREIGN KEY(instrument) REFERENCES instrument (id), 
	CONSTRAINT fk_test_repeats_test FOREIGN KEY(repeats) REFERENCES test (id), 
	CONSTRAINT fk_test_series_series FOREIGN KEY(series) REFERENCES series (id), 
	CONSTRAINT uq_test_sha256 UNIQUE (sha256)
);
INSERT INTO "test" VALUES(1,1,'aaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaa','test.name',1772438400000000,'test.zone',1772438400000000,'simulated','test.from_what',1.0,1,1,'test.who','{"x":[1.5,null,"µ"]}');
CREATE TABLE test_file (
	id INTEGER NOT NULL, 
	test INTEGER NOT NULL, 
	path TEXT NOT NULL, 
	sha256 TEXT NOT NULL, 
	CONSTRAINT pk_test_file PRIMARY KEY (id), 
	CONSTRAINT fk_test_file_sha256_blob FOREIGN KEY(sha256) REFERENCES blob (sha256), 
	CONSTRAINT fk_test_file_test_test FOREIGN KEY(test) REFERENCES test (id), 
	CONSTRAINT uq_test_file_test_path UNIQUE (test, path)
);
INSERT INTO "test_file" VALUES(1,1,'test_file.path','aaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaa');
CREATE TABLE token (
	id INTEGER NOT NULL, 
	person INTEGER NOT NULL, 
	name TEXT NOT NULL, 
	sha256 TEXT NOT NULL, 
	made_at BIGINT NOT NULL, 
	ended_at BIGINT, 
	CONSTRAINT pk_token PRIMARY KEY (id), 
	CONSTRAINT fk_token_person_person FOREIGN KEY(person) REFERENCES person (id), 
	CONSTRAINT uq_token_sha256 UNIQUE (sha256)
);
INSERT INTO "token" VALUES(1,1,'token.name','aaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaa',1772438400000000,1772438400000000);
CREATE TABLE tolerance (
	id INTEGER NOT NULL, 
	series INTEGER NOT NULL, 
	indicator TEXT NOT NULL, 
	lower FLOAT, 
	upper FLOAT, 
	relevance FLOAT, 
	set_at BIGINT NOT NULL, 
	who TEXT NOT NULL, 
	why TEXT NOT NULL, 
	CONSTRAINT pk_tolerance PRIMARY KEY (id), 
	CONSTRAINT fk_tolerance_series_series FOREIGN KEY(series) REFERENCES series (id)
);
INSERT INTO "tolerance" VALUES(1,1,'tolerance.indicator',1.0,1.0,1.0,1772438400000000,'tolerance.who','tolerance.why');
CREATE INDEX ix_test_series_at ON test (series, at);
CREATE INDEX ix_set_aside_test ON set_aside (test);
CREATE INDEX ix_event_machine_at ON event (machine, at);
CREATE INDEX ix_baseline_series ON baseline (series);
CREATE INDEX ix_tolerance_series ON tolerance (series);
CREATE INDEX ix_series_state_state ON series_state (state);
CREATE INDEX ix_alarm_series ON alarm (series);
CREATE INDEX ix_alarm_step_alarm ON alarm_step (alarm);
CREATE INDEX ix_outbox_state_next_at ON outbox (state, next_at);
CREATE INDEX ix_job_state ON job (state);
CREATE TRIGGER "frozen_update_blob" BEFORE UPDATE ON "blob" BEGIN SELECT RAISE(ABORT, 'rows of blob are never changed or deleted'); END;
CREATE TRIGGER "frozen_delete_blob" BEFORE DELETE ON "blob" BEGIN SELECT RAISE(ABORT, 'rows of blob are never changed or deleted'); END;
CREATE TRIGGER "frozen_update_test" BEFORE UPDATE ON "test" BEGIN SELECT RAISE(ABORT, 'rows of test are never changed or deleted'); END;
CREATE TRIGGER "frozen_delete_test" BEFORE DELETE ON "test" BEGIN SELECT RAISE(ABORT, 'rows of test are never changed or deleted'); END;
CREATE TRIGGER "frozen_update_test_file" BEFORE UPDATE ON "test_file" BEGIN SELECT RAISE(ABORT, 'rows of test_file are never changed or deleted'); END;
CREATE TRIGGER "frozen_delete_test_file" BEFORE DELETE ON "test_file" BEGIN SELECT RAISE(ABORT, 'rows of test_file are never changed or deleted'); END;
CREATE TRIGGER "frozen_update_set_aside" BEFORE UPDATE ON "set_aside" BEGIN SELECT RAISE(ABORT, 'rows of set_aside are never changed or deleted'); END;
CREATE TRIGGER "frozen_delete_set_aside" BEFORE DELETE ON "set_aside" BEGIN SELECT RAISE(ABORT, 'rows of set_aside are never changed or deleted'); END;
CREATE TRIGGER "frozen_update_analysis" BEFORE UPDATE ON "analysis" BEGIN SELECT RAISE(ABORT, 'rows of analysis are never changed or deleted'); END;
CREATE TRIGGER "frozen_delete_analysis" BEFORE DELETE ON "analysis" BEGIN SELECT RAISE(ABORT, 'rows of analysis are never changed or deleted'); END;
CREATE TRIGGER "frozen_update_indicator" BEFORE UPDATE ON "indicator" BEGIN SELECT RAISE(ABORT, 'rows of indicator are never changed or deleted'); END;
CREATE TRIGGER "frozen_delete_indicator" BEFORE DELETE ON "indicator" BEGIN SELECT RAISE(ABORT, 'rows of indicator are never changed or deleted'); END;
CREATE TRIGGER "frozen_update_calibration" BEFORE UPDATE ON "calibration" BEGIN SELECT RAISE(ABORT, 'rows of calibration are never changed or deleted'); END;
CREATE TRIGGER "frozen_delete_calibration" BEFORE DELETE ON "calibration" BEGIN SELECT RAISE(ABORT, 'rows of calibration are never changed or deleted'); END;
CREATE TRIGGER "frozen_update_event" BEFORE UPDATE ON "event" BEGIN SELECT RAISE(ABORT, 'rows of event are never changed or deleted'); END;
CREATE TRIGGER "frozen_delete_event" BEFORE DELETE ON "event" BEGIN SELECT RAISE(ABORT, 'rows of event are never changed or deleted'); END;
CREATE TRIGGER "frozen_update_baseline" BEFORE UPDATE ON "baseline" BEGIN SELECT RAISE(ABORT, 'rows of baseline are never changed or deleted'); END;
CREATE TRIGGER "frozen_delete_baseline" BEFORE DELETE ON "baseline" BEGIN SELECT RAISE(ABORT, 'rows of baseline are never changed or deleted'); END;
CREATE TRIGGER "frozen_update_tolerance" BEFORE UPDATE ON "tolerance" BEGIN SELECT RAISE(ABORT, 'rows of tolerance are never changed or deleted'); END;
CREATE TRIGGER "frozen_delete_tolerance" BEFORE DELETE ON "tolerance" BEGIN SELECT RAISE(ABORT, 'rows of tolerance are never changed or deleted'); END;
CREATE TRIGGER "frozen_update_alarm_step" BEFORE UPDATE ON "alarm_step" BEGIN SELECT RAISE(ABORT, 'rows of alarm_step are never changed or deleted'); END;
CREATE TRIGGER "frozen_delete_alarm_step" BEFORE DELETE ON "alarm_step" BEGIN SELECT RAISE(ABORT, 'rows of alarm_step are never changed or deleted'); END;
CREATE TRIGGER "frozen_update_silence" BEFORE UPDATE ON "silence" BEGIN SELECT RAISE(ABORT, 'rows of silence are never changed or deleted'); END;
CREATE TRIGGER "frozen_delete_silence" BEFORE DELETE ON "silence" BEGIN SELECT RAISE(ABORT, 'rows of silence are never changed or deleted'); END;
CREATE TRIGGER "frozen_update_audit" BEFORE UPDATE ON "audit" BEGIN SELECT RAISE(ABORT, 'rows of audit are never changed or deleted'); END;
CREATE TRIGGER "frozen_delete_audit" BEFORE DELETE ON "audit" BEGIN SELECT RAISE(ABORT, 'rows of audit are never changed or deleted'); END;
COMMIT;
