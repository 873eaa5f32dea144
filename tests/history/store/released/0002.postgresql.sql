SET statement_timeout = 0;
SET lock_timeout = 0;
SET idle_in_transaction_session_timeout = 0;
SET client_encoding = 'UTF8';
SET standard_conforming_strings = on;
SELECT pg_catalog.set_config('search_path', '', false);
SET check_function_bodies = false;
SET xmloption = content;
SET client_min_messages = warning;
SET row_security = off;

CREATE FUNCTION public.refuse_change() RETURNS trigger
    LANGUAGE plpgsql
    AS $$ BEGIN RAISE EXCEPTION 'rows of % are never changed or deleted', TG_TABLE_NAME USING ERRCODE = 'integrity_constraint_violation'; END $$;

SET default_tablespace = '';

SET default_table_access_method = heap;

CREATE TABLE public.account (
    id bigint NOT NULL,
    person bigint NOT NULL,
    password text,
    active boolean NOT NULL,
    changed_at bigint NOT NULL
);

CREATE SEQUENCE public.account_id_seq
    START WITH 1
    INCREMENT BY 1
    NO MINVALUE
    NO MAXVALUE
    CACHE 1;

ALTER SEQUENCE public.account_id_seq OWNED BY public.account.id;

CREATE TABLE public.alarm (
    id bigint NOT NULL,
    series bigint,
    instrument bigint,
    held_by bigint,
    opened_at bigint NOT NULL
);

CREATE SEQUENCE public.alarm_id_seq
    START WITH 1
    INCREMENT BY 1
    NO MINVALUE
    NO MAXVALUE
    CACHE 1;

ALTER SEQUENCE public.alarm_id_seq OWNED BY public.alarm.id;

CREATE TABLE public.alarm_step (
    id bigint NOT NULL,
    alarm bigint NOT NULL,
    state text NOT NULL,
    at bigint NOT NULL,
    test bigint,
    facts text NOT NULL,
    who text DEFAULT ''::text NOT NULL,
    why text DEFAULT ''::text NOT NULL,
    CONSTRAINT ck_alarm_step_state CHECK ((state = ANY (ARRAY['open'::text, 'worse'::text, 'held'::text, 'released'::text, 'acknowledged'::text, 'closed as repaired'::text, 'closed as false'::text])))
);

CREATE SEQUENCE public.alarm_step_id_seq
    START WITH 1
    INCREMENT BY 1
    NO MINVALUE
    NO MAXVALUE
    CACHE 1;

ALTER SEQUENCE public.alarm_step_id_seq OWNED BY public.alarm_step.id;

CREATE TABLE public.analysis (
    id bigint NOT NULL,
    test bigint NOT NULL,
    software text NOT NULL,
    settings text NOT NULL,
    inputs_sha256 text NOT NULL,
    made_at bigint NOT NULL,
    supported boolean NOT NULL,
    error text,
    signatures bytea,
    document_sha256 text,
    document bytea
);

CREATE SEQUENCE public.analysis_id_seq
    START WITH 1
    INCREMENT BY 1
    NO MINVALUE
    NO MAXVALUE
    CACHE 1;

ALTER SEQUENCE public.analysis_id_seq OWNED BY public.analysis.id;

CREATE TABLE public.audit (
    number bigint NOT NULL,
    at bigint NOT NULL,
    who text NOT NULL,
    what text NOT NULL,
    subject text NOT NULL,
    old text,
    new text,
    why text DEFAULT ''::text NOT NULL,
    previous text NOT NULL,
    sha256 text NOT NULL
);

CREATE TABLE public.audit_head (
    id integer NOT NULL,
    number bigint NOT NULL,
    sha256 text NOT NULL,
    CONSTRAINT ck_audit_head_only CHECK ((id = 1))
);

CREATE TABLE public.baseline (
    id bigint NOT NULL,
    series bigint NOT NULL,
    tests text NOT NULL,
    since bigint NOT NULL,
    set_at bigint NOT NULL,
    who text NOT NULL,
    why text NOT NULL
);

CREATE SEQUENCE public.baseline_id_seq
    START WITH 1
    INCREMENT BY 1
    NO MINVALUE
    NO MAXVALUE
    CACHE 1;

ALTER SEQUENCE public.baseline_id_seq OWNED BY public.baseline.id;

CREATE TABLE public.blob (
    sha256 text NOT NULL,
    size bigint NOT NULL,
    made_at bigint NOT NULL
);

CREATE TABLE public.calibration (
    id bigint NOT NULL,
    instrument bigint NOT NULL,
    at bigint NOT NULL,
    due bigint,
    certificate text DEFAULT ''::text NOT NULL,
    content text NOT NULL,
    who text DEFAULT ''::text NOT NULL
);

CREATE SEQUENCE public.calibration_id_seq
    START WITH 1
    INCREMENT BY 1
    NO MINVALUE
    NO MAXVALUE
    CACHE 1;

ALTER SEQUENCE public.calibration_id_seq OWNED BY public.calibration.id;

CREATE TABLE public.campaign (
    id bigint NOT NULL,
    machine bigint NOT NULL,
    name text NOT NULL,
    made_at bigint NOT NULL,
    content text NOT NULL
);

CREATE SEQUENCE public.campaign_id_seq
    START WITH 1
    INCREMENT BY 1
    NO MINVALUE
    NO MAXVALUE
    CACHE 1;

ALTER SEQUENCE public.campaign_id_seq OWNED BY public.campaign.id;

CREATE TABLE public.campaign_test (
    id bigint NOT NULL,
    campaign bigint NOT NULL,
    test bigint NOT NULL
);

CREATE SEQUENCE public.campaign_test_id_seq
    START WITH 1
    INCREMENT BY 1
    NO MINVALUE
    NO MAXVALUE
    CACHE 1;

ALTER SEQUENCE public.campaign_test_id_seq OWNED BY public.campaign_test.id;

CREATE TABLE public.drawing (
    id bigint NOT NULL,
    analysis bigint NOT NULL,
    software text NOT NULL,
    made_at bigint NOT NULL,
    content bytea NOT NULL
);

CREATE SEQUENCE public.drawing_id_seq
    START WITH 1
    INCREMENT BY 1
    NO MINVALUE
    NO MAXVALUE
    CACHE 1;

ALTER SEQUENCE public.drawing_id_seq OWNED BY public.drawing.id;

CREATE TABLE public.event (
    id bigint NOT NULL,
    machine bigint,
    instrument bigint,
    kind text NOT NULL,
    at bigint NOT NULL,
    note text NOT NULL,
    who text NOT NULL,
    made_at bigint NOT NULL,
    CONSTRAINT ck_event_kind CHECK ((kind = ANY (ARRAY['repair'::text, 'parameter edit'::text, 'move'::text, 'crash'::text, 'calibration'::text, 'note'::text])))
);

CREATE SEQUENCE public.event_id_seq
    START WITH 1
    INCREMENT BY 1
    NO MINVALUE
    NO MAXVALUE
    CACHE 1;

ALTER SEQUENCE public.event_id_seq OWNED BY public.event.id;

CREATE TABLE public.indicator (
    id bigint NOT NULL,
    analysis bigint NOT NULL,
    name text NOT NULL,
    kind text NOT NULL,
    value double precision NOT NULL,
    standard_uncertainty double precision
);

CREATE SEQUENCE public.indicator_id_seq
    START WITH 1
    INCREMENT BY 1
    NO MINVALUE
    NO MAXVALUE
    CACHE 1;

ALTER SEQUENCE public.indicator_id_seq OWNED BY public.indicator.id;

CREATE TABLE public.instrument (
    id bigint NOT NULL,
    serial text NOT NULL,
    kind text DEFAULT ''::text NOT NULL,
    made_at bigint NOT NULL
);

CREATE SEQUENCE public.instrument_id_seq
    START WITH 1
    INCREMENT BY 1
    NO MINVALUE
    NO MAXVALUE
    CACHE 1;

ALTER SEQUENCE public.instrument_id_seq OWNED BY public.instrument.id;

CREATE TABLE public.job (
    id bigint NOT NULL,
    kind text NOT NULL,
    asked text NOT NULL,
    state text NOT NULL,
    who text DEFAULT ''::text NOT NULL,
    made_at bigint NOT NULL,
    started_at bigint,
    beat_at bigint,
    ended_at bigint,
    worker text DEFAULT ''::text NOT NULL,
    tries integer DEFAULT 0 NOT NULL,
    step text DEFAULT ''::text NOT NULL,
    done integer DEFAULT 0 NOT NULL,
    total integer DEFAULT 0 NOT NULL,
    result bytea,
    error text DEFAULT ''::text NOT NULL,
    CONSTRAINT ck_job_state CHECK ((state = ANY (ARRAY['waiting'::text, 'running'::text, 'done'::text, 'failed'::text, 'cancelled'::text])))
);

CREATE SEQUENCE public.job_id_seq
    START WITH 1
    INCREMENT BY 1
    NO MINVALUE
    NO MAXVALUE
    CACHE 1;

ALTER SEQUENCE public.job_id_seq OWNED BY public.job.id;

CREATE TABLE public.machine (
    id bigint NOT NULL,
    name text NOT NULL,
    kind text DEFAULT ''::text NOT NULL,
    serial text DEFAULT ''::text NOT NULL,
    place text DEFAULT ''::text NOT NULL,
    made_at bigint NOT NULL
);

CREATE SEQUENCE public.machine_id_seq
    START WITH 1
    INCREMENT BY 1
    NO MINVALUE
    NO MAXVALUE
    CACHE 1;

ALTER SEQUENCE public.machine_id_seq OWNED BY public.machine.id;

CREATE TABLE public.outbox (
    id bigint NOT NULL,
    step bigint,
    recipient bigint NOT NULL,
    made_at bigint NOT NULL,
    content text NOT NULL,
    state text NOT NULL,
    tries integer DEFAULT 0 NOT NULL,
    next_at bigint,
    sent_at bigint,
    error text DEFAULT ''::text NOT NULL,
    CONSTRAINT ck_outbox_state CHECK ((state = ANY (ARRAY['waiting'::text, 'sent'::text, 'given up'::text])))
);

CREATE SEQUENCE public.outbox_id_seq
    START WITH 1
    INCREMENT BY 1
    NO MINVALUE
    NO MAXVALUE
    CACHE 1;

ALTER SEQUENCE public.outbox_id_seq OWNED BY public.outbox.id;

CREATE TABLE public.person (
    id bigint NOT NULL,
    name text NOT NULL,
    role text NOT NULL,
    email text DEFAULT ''::text NOT NULL,
    made_at bigint NOT NULL,
    CONSTRAINT ck_person_role CHECK ((role = ANY (ARRAY['reader'::text, 'engineer'::text, 'administrator'::text])))
);

CREATE SEQUENCE public.person_id_seq
    START WITH 1
    INCREMENT BY 1
    NO MINVALUE
    NO MAXVALUE
    CACHE 1;

ALTER SEQUENCE public.person_id_seq OWNED BY public.person.id;

CREATE TABLE public.plan (
    id bigint NOT NULL,
    machine bigint NOT NULL,
    name text NOT NULL,
    made_at bigint NOT NULL,
    due bigint,
    grace_days double precision DEFAULT '7'::double precision NOT NULL,
    done_at bigint,
    document bytea NOT NULL
);

CREATE SEQUENCE public.plan_id_seq
    START WITH 1
    INCREMENT BY 1
    NO MINVALUE
    NO MAXVALUE
    CACHE 1;

ALTER SEQUENCE public.plan_id_seq OWNED BY public.plan.id;

CREATE TABLE public.recipient (
    id bigint NOT NULL,
    channel text NOT NULL,
    address text NOT NULL,
    digest boolean NOT NULL,
    active boolean NOT NULL
);

CREATE SEQUENCE public.recipient_id_seq
    START WITH 1
    INCREMENT BY 1
    NO MINVALUE
    NO MAXVALUE
    CACHE 1;

ALTER SEQUENCE public.recipient_id_seq OWNED BY public.recipient.id;

CREATE TABLE public.schema_version (
    version_num character varying(32) NOT NULL
);

CREATE TABLE public.series (
    id bigint NOT NULL,
    machine bigint NOT NULL,
    name text NOT NULL,
    recipe text NOT NULL,
    recipe_sha256 text NOT NULL,
    software text NOT NULL,
    interval_days double precision,
    grace_days double precision DEFAULT '7'::double precision NOT NULL,
    alpha double precision DEFAULT '0.005'::double precision NOT NULL
);

CREATE SEQUENCE public.series_id_seq
    START WITH 1
    INCREMENT BY 1
    NO MINVALUE
    NO MAXVALUE
    CACHE 1;

ALTER SEQUENCE public.series_id_seq OWNED BY public.series.id;

CREATE TABLE public.series_state (
    series bigint NOT NULL,
    version bigint NOT NULL,
    state text NOT NULL,
    since bigint,
    last_test bigint,
    due bigint,
    verdict bytea NOT NULL
);

CREATE TABLE public.session (
    id bigint NOT NULL,
    person bigint NOT NULL,
    sha256 text NOT NULL,
    made_at bigint NOT NULL,
    seen_at bigint NOT NULL,
    ended_at bigint
);

CREATE SEQUENCE public.session_id_seq
    START WITH 1
    INCREMENT BY 1
    NO MINVALUE
    NO MAXVALUE
    CACHE 1;

ALTER SEQUENCE public.session_id_seq OWNED BY public.session.id;

CREATE TABLE public.set_aside (
    id bigint NOT NULL,
    test bigint NOT NULL,
    aside boolean NOT NULL,
    at bigint NOT NULL,
    who text NOT NULL,
    why text NOT NULL
);

CREATE SEQUENCE public.set_aside_id_seq
    START WITH 1
    INCREMENT BY 1
    NO MINVALUE
    NO MAXVALUE
    CACHE 1;

ALTER SEQUENCE public.set_aside_id_seq OWNED BY public.set_aside.id;

CREATE TABLE public.silence (
    id bigint NOT NULL,
    machine bigint NOT NULL,
    until bigint NOT NULL,
    at bigint NOT NULL,
    who text NOT NULL,
    why text NOT NULL
);

CREATE SEQUENCE public.silence_id_seq
    START WITH 1
    INCREMENT BY 1
    NO MINVALUE
    NO MAXVALUE
    CACHE 1;

ALTER SEQUENCE public.silence_id_seq OWNED BY public.silence.id;

CREATE TABLE public.test (
    id bigint NOT NULL,
    series bigint NOT NULL,
    sha256 text NOT NULL,
    name text NOT NULL,
    at bigint NOT NULL,
    zone text DEFAULT ''::text NOT NULL,
    imported_at bigint NOT NULL,
    origin text NOT NULL,
    from_what text DEFAULT ''::text NOT NULL,
    temperature double precision,
    instrument bigint,
    repeats bigint,
    who text DEFAULT ''::text NOT NULL,
    about text NOT NULL,
    CONSTRAINT ck_test_origin CHECK ((origin = ANY (ARRAY['measured'::text, 'simulated'::text, 'reconstructed'::text])))
);

CREATE TABLE public.test_file (
    id bigint NOT NULL,
    test bigint NOT NULL,
    path text NOT NULL,
    sha256 text NOT NULL
);

CREATE SEQUENCE public.test_file_id_seq
    START WITH 1
    INCREMENT BY 1
    NO MINVALUE
    NO MAXVALUE
    CACHE 1;

ALTER SEQUENCE public.test_file_id_seq OWNED BY public.test_file.id;

CREATE SEQUENCE public.test_id_seq
    START WITH 1
    INCREMENT BY 1
    NO MINVALUE
    NO MAXVALUE
    CACHE 1;

ALTER SEQUENCE public.test_id_seq OWNED BY public.test.id;

CREATE TABLE public.token (
    id bigint NOT NULL,
    person bigint NOT NULL,
    name text NOT NULL,
    sha256 text NOT NULL,
    made_at bigint NOT NULL,
    ended_at bigint
);

CREATE SEQUENCE public.token_id_seq
    START WITH 1
    INCREMENT BY 1
    NO MINVALUE
    NO MAXVALUE
    CACHE 1;

ALTER SEQUENCE public.token_id_seq OWNED BY public.token.id;

CREATE TABLE public.tolerance (
    id bigint NOT NULL,
    series bigint NOT NULL,
    indicator text NOT NULL,
    lower double precision,
    upper double precision,
    relevance double precision,
    set_at bigint NOT NULL,
    who text NOT NULL,
    why text NOT NULL
);

CREATE SEQUENCE public.tolerance_id_seq
    START WITH 1
    INCREMENT BY 1
    NO MINVALUE
    NO MAXVALUE
    CACHE 1;

ALTER SEQUENCE public.tolerance_id_seq OWNED BY public.tolerance.id;

ALTER TABLE ONLY public.account ALTER COLUMN id SET DEFAULT nextval('public.account_id_seq'::regclass);

ALTER TABLE ONLY public.alarm ALTER COLUMN id SET DEFAULT nextval('public.alarm_id_seq'::regclass);

ALTER TABLE ONLY public.alarm_step ALTER COLUMN id SET DEFAULT nextval('public.alarm_step_id_seq'::regclass);

ALTER TABLE ONLY public.analysis ALTER COLUMN id SET DEFAULT nextval('public.analysis_id_seq'::regclass);

ALTER TABLE ONLY public.baseline ALTER COLUMN id SET DEFAULT nextval('public.baseline_id_seq'::regclass);

ALTER TABLE ONLY public.calibration ALTER COLUMN id SET DEFAULT nextval('public.calibration_id_seq'::regclass);

ALTER TABLE ONLY public.campaign ALTER COLUMN id SET DEFAULT nextval('public.campaign_id_seq'::regclass);

ALTER TABLE ONLY public.campaign_test ALTER COLUMN id SET DEFAULT nextval('public.campaign_test_id_seq'::regclass);

ALTER TABLE ONLY public.drawing ALTER COLUMN id SET DEFAULT nextval('public.drawing_id_seq'::regclass);

ALTER TABLE ONLY public.event ALTER COLUMN id SET DEFAULT nextval('public.event_id_seq'::regclass);

ALTER TABLE ONLY public.indicator ALTER COLUMN id SET DEFAULT nextval('public.indicator_id_seq'::regclass);

ALTER TABLE ONLY public.instrument ALTER COLUMN id SET DEFAULT nextval('public.instrument_id_seq'::regclass);

ALTER TABLE ONLY public.job ALTER COLUMN id SET DEFAULT nextval('public.job_id_seq'::regclass);

ALTER TABLE ONLY public.machine ALTER COLUMN id SET DEFAULT nextval('public.machine_id_seq'::regclass);

ALTER TABLE ONLY public.outbox ALTER COLUMN id SET DEFAULT nextval('public.outbox_id_seq'::regclass);

ALTER TABLE ONLY public.person ALTER COLUMN id SET DEFAULT nextval('public.person_id_seq'::regclass);

ALTER TABLE ONLY public.plan ALTER COLUMN id SET DEFAULT nextval('public.plan_id_seq'::regclass);

ALTER TABLE ONLY public.recipient ALTER COLUMN id SET DEFAULT nextval('public.recipient_id_seq'::regclass);

ALTER TABLE ONLY public.series ALTER COLUMN id SET DEFAULT nextval('public.series_id_seq'::regclass);

ALTER TABLE ONLY public.session ALTER COLUMN id SET DEFAULT nextval('public.session_id_seq'::regclass);

ALTER TABLE ONLY public.set_aside ALTER COLUMN id SET DEFAULT nextval('public.set_aside_id_seq'::regclass);

ALTER TABLE ONLY public.silence ALTER COLUMN id SET DEFAULT nextval('public.silence_id_seq'::regclass);

ALTER TABLE ONLY public.test ALTER COLUMN id SET DEFAULT nextval('public.test_id_seq'::regclass);

ALTER TABLE ONLY public.test_file ALTER COLUMN id SET DEFAULT nextval('public.test_file_id_seq'::regclass);

ALTER TABLE ONLY public.token ALTER COLUMN id SET DEFAULT nextval('public.token_id_seq'::regclass);

ALTER TABLE ONLY public.tolerance ALTER COLUMN id SET DEFAULT nextval('public.tolerance_id_seq'::regclass);

INSERT INTO public.account VALUES (1, 1, 'account.password', true, 1772438400000000);

INSERT INTO public.alarm VALUES (1, 1, 1, 1, 1772438400000000);

INSERT INTO public.alarm_step VALUES (1, 1, 'open', 1772438400000000, 1, '{"x":[1.5,null,"µ"]}', 'alarm_step.who', 'alarm_step.why');

INSERT INTO public.analysis VALUES (1, 1, 'analysis.software', '{"x":[1.5,null,"µ"]}', 'analysis.inputs_sha256', 1772438400000000, true, 'analysis.error', '\x789cab56aa50b28a36d433d5c92bcdc9d1513ab45529b6160046810709', 'analysis.document_sha256', '\x789cab56aa50b28a36d433d5c92bcdc9d1513ab45529b6160046810709');

INSERT INTO public.audit VALUES (1, 1772445600000000, 'A. Miller', 'migrate', 'schema', NULL, '"0002"', 'elastogeo 0.2.0', '0000000000000000000000000000000000000000000000000000000000000000', 'bef9b06be8b785d4122d38e890d59c585c759b1437f26f8677ccaabf9955339a');
INSERT INTO public.audit VALUES (2, 1772449200000000, 'A. Miller', 'set aside', 'test 1', 'false', 'true', 'ball not seated', 'bef9b06be8b785d4122d38e890d59c585c759b1437f26f8677ccaabf9955339a', '13984ba645ec6a921599601f41f41e3509ca05262dd0b4ed2d10362f06ab210d');

INSERT INTO public.audit_head VALUES (1, 2, '13984ba645ec6a921599601f41f41e3509ca05262dd0b4ed2d10362f06ab210d');

INSERT INTO public.baseline VALUES (1, 1, '{"x":[1.5,null,"µ"]}', 1772438400000000, 1772438400000000, 'baseline.who', 'baseline.why');

INSERT INTO public.blob VALUES ('aaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaa', 1, 1772438400000000);

INSERT INTO public.calibration VALUES (1, 1, 1772438400000000, 1772438400000000, 'calibration.certificate', '{"x":[1.5,null,"µ"]}', 'calibration.who');

INSERT INTO public.campaign VALUES (1, 1, 'campaign.name', 1772438400000000, '{"x":[1.5,null,"µ"]}');

INSERT INTO public.campaign_test VALUES (1, 1, 1);

INSERT INTO public.drawing VALUES (1, 1, 'drawing.software', 1772438400000000, '\x789cab56aa50b28a36d433d5c92bcdc9d1513ab45529b6160046810709');

INSERT INTO public.event VALUES (1, 1, 1, 'repair', 1772438400000000, 'event.note', 'event.who', 1772438400000000);

INSERT INTO public.indicator VALUES (1, 1, 'indicator.name', 'indicator.kind', 1, 1);

INSERT INTO public.instrument VALUES (1, 'instrument.serial', 'instrument.kind', 1772438400000000);

INSERT INTO public.job VALUES (1, 'job.kind', '{"x":[1.5,null,"µ"]}', 'waiting', 'job.who', 1772438400000000, 1772438400000000, 1772438400000000, 1772438400000000, 'job.worker', 1, 'job.step', 1, 1, '\x789cab56aa50b28a36d433d5c92bcdc9d1513ab45529b6160046810709', 'job.error');

INSERT INTO public.machine VALUES (1, 'machine.name', 'machine.kind', 'machine.serial', 'machine.place', 1772438400000000);

INSERT INTO public.outbox VALUES (1, 1, 1, 1772438400000000, '{"x":[1.5,null,"µ"]}', 'waiting', 1, 1772438400000000, 1772438400000000, 'outbox.error');

INSERT INTO public.person VALUES (1, 'person.name', 'reader', 'person.email', 1772438400000000);

INSERT INTO public.plan VALUES (1, 1, 'plan.name', 1772438400000000, 1772438400000000, 1, 1772438400000000, '\x789cab56aa50b28a36d433d5c92bcdc9d1513ab45529b6160046810709');

INSERT INTO public.recipient VALUES (1, 'recipient.channel', 'recipient.address', true, true);

INSERT INTO public.schema_version VALUES ('0002');

INSERT INTO public.series VALUES (1, 1, 'series.name', '{"x":[1.5,null,"µ"]}', 'series.recipe_sha256', 'series.software', 1, 1, 1);

INSERT INTO public.series_state VALUES (1, 1, 'open', 1772438400000000, 1772438400000000, 1772438400000000, '\x789cab56aa50b28a36d433d5c92bcdc9d1513ab45529b6160046810709');

INSERT INTO public.session VALUES (1, 1, 'aaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaa', 1772438400000000, 1772438400000000, 1772438400000000);

INSERT INTO public.set_aside VALUES (1, 1, true, 1772438400000000, 'set_aside.who', 'set_aside.why');

INSERT INTO public.silence VALUES (1, 1, 1772438400000000, 1772438400000000, 'silence.who', 'silence.why');

INSERT INTO public.test VALUES (1, 1, 'aaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaa', 'test.name', 1772438400000000, 'test.zone', 1772438400000000, 'simulated', 'test.from_what', 1, 1, 1, 'test.who', '{"x":[1.5,null,"µ"]}');

INSERT INTO public.test_file VALUES (1, 1, 'test_file.path', 'aaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaa');

INSERT INTO public.token VALUES (1, 1, 'token.name', 'aaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaa', 1772438400000000, 1772438400000000);

INSERT INTO public.tolerance VALUES (1, 1, 'tolerance.indicator', 1, 1, 1, 1772438400000000, 'tolerance.who', 'tolerance.why');

SELECT pg_catalog.setval('public.account_id_seq', 1, false);

SELECT pg_catalog.setval('public.alarm_id_seq', 1, false);

SELECT pg_catalog.setval('public.alarm_step_id_seq', 1, false);

SELECT pg_catalog.setval('public.analysis_id_seq', 1, false);

SELECT pg_catalog.setval('public.baseline_id_seq', 1, false);

SELECT pg_catalog.setval('public.calibration_id_seq', 1, false);

SELECT pg_catalog.setval('public.campaign_id_seq', 1, false);

SELECT pg_catalog.setval('public.campaign_test_id_seq', 1, false);

SELECT pg_catalog.setval('public.drawing_id_seq', 1, false);

SELECT pg_catalog.setval('public.event_id_seq', 1, false);

SELECT pg_catalog.setval('public.indicator_id_seq', 1, false);

SELECT pg_catalog.setval('public.instrument_id_seq', 1, false);

SELECT pg_catalog.setval('public.job_id_seq', 1, false);

SELECT pg_catalog.setval('public.machine_id_seq', 1, false);

SELECT pg_catalog.setval('public.outbox_id_seq', 1, false);

SELECT pg_catalog.setval('public.person_id_seq', 1, false);

SELECT pg_catalog.setval('public.plan_id_seq', 1, false);

SELECT pg_catalog.setval('public.recipient_id_seq', 1, false);

SELECT pg_catalog.setval('public.series_id_seq', 1, false);

SELECT pg_catalog.setval('public.session_id_seq', 1, false);

SELECT pg_catalog.setval('public.set_aside_id_seq', 1, false);

SELECT pg_catalog.setval('public.silence_id_seq', 1, false);

SELECT pg_catalog.setval('public.test_file_id_seq', 1, false);

SELECT pg_catalog.setval('public.test_id_seq', 1, false);

SELECT pg_catalog.setval('public.token_id_seq', 1, false);

SELECT pg_catalog.setval('public.tolerance_id_seq', 1, false);

ALTER TABLE ONLY public.account
    ADD CONSTRAINT pk_account PRIMARY KEY (id);

ALTER TABLE ONLY public.alarm
    ADD CONSTRAINT pk_alarm PRIMARY KEY (id);

ALTER TABLE ONLY public.alarm_step
    ADD CONSTRAINT pk_alarm_step PRIMARY KEY (id);

ALTER TABLE ONLY public.analysis
    ADD CONSTRAINT pk_analysis PRIMARY KEY (id);

ALTER TABLE ONLY public.audit
    ADD CONSTRAINT pk_audit PRIMARY KEY (number);

ALTER TABLE ONLY public.audit_head
    ADD CONSTRAINT pk_audit_head PRIMARY KEY (id);

ALTER TABLE ONLY public.baseline
    ADD CONSTRAINT pk_baseline PRIMARY KEY (id);

ALTER TABLE ONLY public.blob
    ADD CONSTRAINT pk_blob PRIMARY KEY (sha256);

ALTER TABLE ONLY public.calibration
    ADD CONSTRAINT pk_calibration PRIMARY KEY (id);

ALTER TABLE ONLY public.campaign
    ADD CONSTRAINT pk_campaign PRIMARY KEY (id);

ALTER TABLE ONLY public.campaign_test
    ADD CONSTRAINT pk_campaign_test PRIMARY KEY (id);

ALTER TABLE ONLY public.drawing
    ADD CONSTRAINT pk_drawing PRIMARY KEY (id);

ALTER TABLE ONLY public.event
    ADD CONSTRAINT pk_event PRIMARY KEY (id);

ALTER TABLE ONLY public.indicator
    ADD CONSTRAINT pk_indicator PRIMARY KEY (id);

ALTER TABLE ONLY public.instrument
    ADD CONSTRAINT pk_instrument PRIMARY KEY (id);

ALTER TABLE ONLY public.job
    ADD CONSTRAINT pk_job PRIMARY KEY (id);

ALTER TABLE ONLY public.machine
    ADD CONSTRAINT pk_machine PRIMARY KEY (id);

ALTER TABLE ONLY public.outbox
    ADD CONSTRAINT pk_outbox PRIMARY KEY (id);

ALTER TABLE ONLY public.person
    ADD CONSTRAINT pk_person PRIMARY KEY (id);

ALTER TABLE ONLY public.plan
    ADD CONSTRAINT pk_plan PRIMARY KEY (id);

ALTER TABLE ONLY public.recipient
    ADD CONSTRAINT pk_recipient PRIMARY KEY (id);

ALTER TABLE ONLY public.series
    ADD CONSTRAINT pk_series PRIMARY KEY (id);

ALTER TABLE ONLY public.series_state
    ADD CONSTRAINT pk_series_state PRIMARY KEY (series);

ALTER TABLE ONLY public.session
    ADD CONSTRAINT pk_session PRIMARY KEY (id);

ALTER TABLE ONLY public.set_aside
    ADD CONSTRAINT pk_set_aside PRIMARY KEY (id);

ALTER TABLE ONLY public.silence
    ADD CONSTRAINT pk_silence PRIMARY KEY (id);

ALTER TABLE ONLY public.test
    ADD CONSTRAINT pk_test PRIMARY KEY (id);

ALTER TABLE ONLY public.test_file
    ADD CONSTRAINT pk_test_file PRIMARY KEY (id);

ALTER TABLE ONLY public.token
    ADD CONSTRAINT pk_token PRIMARY KEY (id);

ALTER TABLE ONLY public.tolerance
    ADD CONSTRAINT pk_tolerance PRIMARY KEY (id);

ALTER TABLE ONLY public.schema_version
    ADD CONSTRAINT schema_version_pkc PRIMARY KEY (version_num);

ALTER TABLE ONLY public.account
    ADD CONSTRAINT uq_account_person UNIQUE (person);

ALTER TABLE ONLY public.analysis
    ADD CONSTRAINT uq_analysis_test_software_inputs_sha256 UNIQUE (test, software, inputs_sha256);

ALTER TABLE ONLY public.audit
    ADD CONSTRAINT uq_audit_sha256 UNIQUE (sha256);

ALTER TABLE ONLY public.campaign
    ADD CONSTRAINT uq_campaign_machine_name UNIQUE (machine, name);

ALTER TABLE ONLY public.campaign_test
    ADD CONSTRAINT uq_campaign_test_campaign_test UNIQUE (campaign, test);

ALTER TABLE ONLY public.drawing
    ADD CONSTRAINT uq_drawing_analysis_software UNIQUE (analysis, software);

ALTER TABLE ONLY public.indicator
    ADD CONSTRAINT uq_indicator_analysis_name UNIQUE (analysis, name);

ALTER TABLE ONLY public.instrument
    ADD CONSTRAINT uq_instrument_serial UNIQUE (serial);

ALTER TABLE ONLY public.machine
    ADD CONSTRAINT uq_machine_name UNIQUE (name);

ALTER TABLE ONLY public.outbox
    ADD CONSTRAINT uq_outbox_step_recipient UNIQUE (step, recipient);

ALTER TABLE ONLY public.person
    ADD CONSTRAINT uq_person_name UNIQUE (name);

ALTER TABLE ONLY public.plan
    ADD CONSTRAINT uq_plan_machine_name UNIQUE (machine, name);

ALTER TABLE ONLY public.recipient
    ADD CONSTRAINT uq_recipient_channel_address UNIQUE (channel, address);

ALTER TABLE ONLY public.series
    ADD CONSTRAINT uq_series_machine_name UNIQUE (machine, name);

ALTER TABLE ONLY public.series
    ADD CONSTRAINT uq_series_machine_recipe_sha256 UNIQUE (machine, recipe_sha256);

ALTER TABLE ONLY public.session
    ADD CONSTRAINT uq_session_sha256 UNIQUE (sha256);

ALTER TABLE ONLY public.test_file
    ADD CONSTRAINT uq_test_file_test_path UNIQUE (test, path);

ALTER TABLE ONLY public.test
    ADD CONSTRAINT uq_test_sha256 UNIQUE (sha256);

ALTER TABLE ONLY public.token
    ADD CONSTRAINT uq_token_sha256 UNIQUE (sha256);

CREATE INDEX ix_alarm_series ON public.alarm USING btree (series);

CREATE INDEX ix_alarm_step_alarm ON public.alarm_step USING btree (alarm);

CREATE INDEX ix_baseline_series ON public.baseline USING btree (series);

CREATE INDEX ix_event_machine_at ON public.event USING btree (machine, at);

CREATE INDEX ix_job_state ON public.job USING btree (state);

CREATE INDEX ix_outbox_state_next_at ON public.outbox USING btree (state, next_at);

CREATE INDEX ix_series_state_state ON public.series_state USING btree (state);

CREATE INDEX ix_set_aside_test ON public.set_aside USING btree (test);

CREATE INDEX ix_test_series_at ON public.test USING btree (series, at);

CREATE INDEX ix_tolerance_series ON public.tolerance USING btree (series);

CREATE TRIGGER frozen_change_alarm_step BEFORE DELETE OR UPDATE ON public.alarm_step FOR EACH ROW EXECUTE FUNCTION public.refuse_change();

CREATE TRIGGER frozen_change_analysis BEFORE DELETE OR UPDATE ON public.analysis FOR EACH ROW EXECUTE FUNCTION public.refuse_change();

CREATE TRIGGER frozen_change_audit BEFORE DELETE OR UPDATE ON public.audit FOR EACH ROW EXECUTE FUNCTION public.refuse_change();

CREATE TRIGGER frozen_change_baseline BEFORE DELETE OR UPDATE ON public.baseline FOR EACH ROW EXECUTE FUNCTION public.refuse_change();

CREATE TRIGGER frozen_change_blob BEFORE DELETE OR UPDATE ON public.blob FOR EACH ROW EXECUTE FUNCTION public.refuse_change();

CREATE TRIGGER frozen_change_calibration BEFORE DELETE OR UPDATE ON public.calibration FOR EACH ROW EXECUTE FUNCTION public.refuse_change();

CREATE TRIGGER frozen_change_event BEFORE DELETE OR UPDATE ON public.event FOR EACH ROW EXECUTE FUNCTION public.refuse_change();

CREATE TRIGGER frozen_change_indicator BEFORE DELETE OR UPDATE ON public.indicator FOR EACH ROW EXECUTE FUNCTION public.refuse_change();

CREATE TRIGGER frozen_change_set_aside BEFORE DELETE OR UPDATE ON public.set_aside FOR EACH ROW EXECUTE FUNCTION public.refuse_change();

CREATE TRIGGER frozen_change_silence BEFORE DELETE OR UPDATE ON public.silence FOR EACH ROW EXECUTE FUNCTION public.refuse_change();

CREATE TRIGGER frozen_change_test BEFORE DELETE OR UPDATE ON public.test FOR EACH ROW EXECUTE FUNCTION public.refuse_change();

CREATE TRIGGER frozen_change_test_file BEFORE DELETE OR UPDATE ON public.test_file FOR EACH ROW EXECUTE FUNCTION public.refuse_change();

CREATE TRIGGER frozen_change_tolerance BEFORE DELETE OR UPDATE ON public.tolerance FOR EACH ROW EXECUTE FUNCTION public.refuse_change();

CREATE TRIGGER frozen_truncate_alarm_step BEFORE TRUNCATE ON public.alarm_step FOR EACH STATEMENT EXECUTE FUNCTION public.refuse_change();

CREATE TRIGGER frozen_truncate_analysis BEFORE TRUNCATE ON public.analysis FOR EACH STATEMENT EXECUTE FUNCTION public.refuse_change();

CREATE TRIGGER frozen_truncate_audit BEFORE TRUNCATE ON public.audit FOR EACH STATEMENT EXECUTE FUNCTION public.refuse_change();

CREATE TRIGGER frozen_truncate_baseline BEFORE TRUNCATE ON public.baseline FOR EACH STATEMENT EXECUTE FUNCTION public.refuse_change();

CREATE TRIGGER frozen_truncate_blob BEFORE TRUNCATE ON public.blob FOR EACH STATEMENT EXECUTE FUNCTION public.refuse_change();

CREATE TRIGGER frozen_truncate_calibration BEFORE TRUNCATE ON public.calibration FOR EACH STATEMENT EXECUTE FUNCTION public.refuse_change();

CREATE TRIGGER frozen_truncate_event BEFORE TRUNCATE ON public.event FOR EACH STATEMENT EXECUTE FUNCTION public.refuse_change();

CREATE TRIGGER frozen_truncate_indicator BEFORE TRUNCATE ON public.indicator FOR EACH STATEMENT EXECUTE FUNCTION public.refuse_change();

CREATE TRIGGER frozen_truncate_set_aside BEFORE TRUNCATE ON public.set_aside FOR EACH STATEMENT EXECUTE FUNCTION public.refuse_change();

CREATE TRIGGER frozen_truncate_silence BEFORE TRUNCATE ON public.silence FOR EACH STATEMENT EXECUTE FUNCTION public.refuse_change();

CREATE TRIGGER frozen_truncate_test BEFORE TRUNCATE ON public.test FOR EACH STATEMENT EXECUTE FUNCTION public.refuse_change();

CREATE TRIGGER frozen_truncate_test_file BEFORE TRUNCATE ON public.test_file FOR EACH STATEMENT EXECUTE FUNCTION public.refuse_change();

CREATE TRIGGER frozen_truncate_tolerance BEFORE TRUNCATE ON public.tolerance FOR EACH STATEMENT EXECUTE FUNCTION public.refuse_change();

ALTER TABLE ONLY public.account
    ADD CONSTRAINT fk_account_person_person FOREIGN KEY (person) REFERENCES public.person(id);

ALTER TABLE ONLY public.alarm
    ADD CONSTRAINT fk_alarm_held_by_alarm FOREIGN KEY (held_by) REFERENCES public.alarm(id);

ALTER TABLE ONLY public.alarm
    ADD CONSTRAINT fk_alarm_instrument_instrument FOREIGN KEY (instrument) REFERENCES public.instrument(id);

ALTER TABLE ONLY public.alarm
    ADD CONSTRAINT fk_alarm_series_series FOREIGN KEY (series) REFERENCES public.series(id);

ALTER TABLE ONLY public.alarm_step
    ADD CONSTRAINT fk_alarm_step_alarm_alarm FOREIGN KEY (alarm) REFERENCES public.alarm(id);

ALTER TABLE ONLY public.alarm_step
    ADD CONSTRAINT fk_alarm_step_test_test FOREIGN KEY (test) REFERENCES public.test(id);

ALTER TABLE ONLY public.analysis
    ADD CONSTRAINT fk_analysis_test_test FOREIGN KEY (test) REFERENCES public.test(id);

ALTER TABLE ONLY public.baseline
    ADD CONSTRAINT fk_baseline_series_series FOREIGN KEY (series) REFERENCES public.series(id);

ALTER TABLE ONLY public.calibration
    ADD CONSTRAINT fk_calibration_instrument_instrument FOREIGN KEY (instrument) REFERENCES public.instrument(id);

ALTER TABLE ONLY public.campaign
    ADD CONSTRAINT fk_campaign_machine_machine FOREIGN KEY (machine) REFERENCES public.machine(id);

ALTER TABLE ONLY public.campaign_test
    ADD CONSTRAINT fk_campaign_test_campaign_campaign FOREIGN KEY (campaign) REFERENCES public.campaign(id);

ALTER TABLE ONLY public.campaign_test
    ADD CONSTRAINT fk_campaign_test_test_test FOREIGN KEY (test) REFERENCES public.test(id);

ALTER TABLE ONLY public.drawing
    ADD CONSTRAINT fk_drawing_analysis_analysis FOREIGN KEY (analysis) REFERENCES public.analysis(id);

ALTER TABLE ONLY public.event
    ADD CONSTRAINT fk_event_instrument_instrument FOREIGN KEY (instrument) REFERENCES public.instrument(id);

ALTER TABLE ONLY public.event
    ADD CONSTRAINT fk_event_machine_machine FOREIGN KEY (machine) REFERENCES public.machine(id);

ALTER TABLE ONLY public.indicator
    ADD CONSTRAINT fk_indicator_analysis_analysis FOREIGN KEY (analysis) REFERENCES public.analysis(id);

ALTER TABLE ONLY public.outbox
    ADD CONSTRAINT fk_outbox_recipient_recipient FOREIGN KEY (recipient) REFERENCES public.recipient(id);

ALTER TABLE ONLY public.outbox
    ADD CONSTRAINT fk_outbox_step_alarm_step FOREIGN KEY (step) REFERENCES public.alarm_step(id);

ALTER TABLE ONLY public.plan
    ADD CONSTRAINT fk_plan_machine_machine FOREIGN KEY (machine) REFERENCES public.machine(id);

ALTER TABLE ONLY public.series
    ADD CONSTRAINT fk_series_machine_machine FOREIGN KEY (machine) REFERENCES public.machine(id);

ALTER TABLE ONLY public.series_state
    ADD CONSTRAINT fk_series_state_series_series FOREIGN KEY (series) REFERENCES public.series(id);

ALTER TABLE ONLY public.session
    ADD CONSTRAINT fk_session_person_person FOREIGN KEY (person) REFERENCES public.person(id);

ALTER TABLE ONLY public.set_aside
    ADD CONSTRAINT fk_set_aside_test_test FOREIGN KEY (test) REFERENCES public.test(id);

ALTER TABLE ONLY public.silence
    ADD CONSTRAINT fk_silence_machine_machine FOREIGN KEY (machine) REFERENCES public.machine(id);

ALTER TABLE ONLY public.test_file
    ADD CONSTRAINT fk_test_file_sha256_blob FOREIGN KEY (sha256) REFERENCES public.blob(sha256);

ALTER TABLE ONLY public.test_file
    ADD CONSTRAINT fk_test_file_test_test FOREIGN KEY (test) REFERENCES public.test(id);

ALTER TABLE ONLY public.test
    ADD CONSTRAINT fk_test_instrument_instrument FOREIGN KEY (instrument) REFERENCES public.instrument(id);

ALTER TABLE ONLY public.test
    ADD CONSTRAINT fk_test_repeats_test FOREIGN KEY (repeats) REFERENCES public.test(id);

ALTER TABLE ONLY public.test
    ADD CONSTRAINT fk_test_series_series FOREIGN KEY (series) REFERENCES public.series(id);

ALTER TABLE ONLY public.token
    ADD CONSTRAINT fk_token_person_person FOREIGN KEY (person) REFERENCES public.person(id);

ALTER TABLE ONLY public.tolerance
    ADD CONSTRAINT fk_tolerance_series_series FOREIGN KEY (series) REFERENCES public.series(id);
