"""What comes next on a machine of a history: maps of what is identified, tests to plan, programs. A part of `History`."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import asdict
from math import cos, radians, sin
from typing import Any

from sqlalchemy import select

from elastogeo.changes import (
    ChangeVerdict,
    KeptJob,
    KeptPlan,
    NextGoal,
    NextTests,
    PlanToDo,
    ProgramFacts,
    planned_components,
)
from elastogeo.changes.records import DONE, TELL
from elastogeo.errors import InputError
from elastogeo.history.analyses.bases import Basis, bases, definition_of
from elastogeo.history.analyses.kept_plans import due_date, keep_plan, plans
from elastogeo.history.analyses.map_job import MAP
from elastogeo.history.analyses.plan_job import PLAN
from elastogeo.history.analyses.planned_files import folder_of, program_of
from elastogeo.history.jobs import rows
from elastogeo.history.store import Store, now, read
from elastogeo.history.store.schema import job
from elastogeo.planning import proposals
from elastogeo.prediction import ElementMap, MapSection, section_of

STIFFNESS_KIND = "stiffness"
_MOST_JOBS = 200
_ROUNDING = 1e-12
"""Of a direction's part: less is the rounding of a cosine."""


class Ahead:
    """What is done with an open history to look ahead.

    Attributes
    ----------
    store : Store
    who : str
        Who asks.
    """

    store: Store
    who: str

    def map_bases(self, machine: int) -> tuple[Basis, ...]:
        """What a map of a machine may rest on: its supported campaigns and the last supported test of each series."""
        with read(self.store) as connection:
            return bases(connection, machine)

    def put_map(self, machine: int, kind: str = "", key: int = 0) -> int:
        """Ask for the map of a machine; the number of the job."""
        asked: dict[str, Any] = {"machine": machine}
        return rows.put_job(self.store, MAP, asked | ({"kind": kind, "key": key} if kind else {}), self.who)

    def map_job(self, machine: int, kind: str = "", key: int = 0) -> KeptJob | None:
        """The last job that mapped a machine, or is to: of one basis, or any; None if none was asked for."""
        for found in self._jobs(MAP, machine):
            basis = (found.result or {}).get("basis", found.asked)
            if not kind or (basis.get("kind"), basis.get("key")) == (kind, key):
                return found
        return None

    @staticmethod
    def map_of(found: KeptJob) -> ElementMap:
        """The map that a job made.

        Raises
        ------
        InputError
            If it made none.
        """
        if found.kind != MAP or found.state != DONE or found.result is None:
            raise InputError(f"job {found.key} has made no map")
        return ElementMap.of_document(found.result["map"])

    def map_section(
        self,
        found: KeptJob,
        plane: str = "",
        height: int | None = None,
        azimuth: float = 0.0,
        elevation: float = 0.0,
        assumed: bool = False,
    ) -> MapSection:
        """A section through the map that a job made.

        Parameters
        ----------
        found : KeptJob
        plane : str
            Two axes: `XY`.
        height : int, optional
            Place of the third axis, counted from 0.
        azimuth, elevation : float [deg]
            Of the direction: from X to Y, and up to Z.
        assumed : bool
            Whether to show what rests on rigid joints.

        Raises
        ------
        InputError
            If the job made no map, or the section is none.
        """
        a, e = radians(azimuth), radians(elevation)
        way = cos(e) * cos(a), cos(e) * sin(a), sin(e)
        exact = tuple(0.0 if abs(part) < _ROUNDING else part for part in way)
        return section_of(self.map_of(found), plane, height, exact, assumed)

    def components(self, machine: int) -> tuple[str, ...]:
        """The components of a machine that planned tests may tell apart.

        Raises
        ------
        InputError
            If nothing describes the machine.
        """
        return tuple(planned_components(definition_of(self.store, machine).machine))

    def instruments_to_plan(self) -> tuple[str, ...]:
        """The instruments of which tests can be planned."""
        return tuple(proposals())

    def goals(self, verdicts: Sequence[ChangeVerdict], components: Sequence[str]) -> tuple[NextGoal, ...]:
        """What tests may be for that a machine's series cannot tell: the sets of components, those that tests can tell.

        Parameters
        ----------
        verdicts : sequence of ChangeVerdict
            Of its series.
        components : sequence of str
            That planned tests may tell apart.
        """
        found: list[NextGoal] = []
        for verdict in verdicts:
            for group in verdict.cannot_tell:
                known = tuple(name for name in group if name in components)
                if len(known) > 1 and all(one.between != known for one in found):
                    found.append(NextGoal(TELL, known))
        return tuple(found)

    @staticmethod
    def least_compliance(verdicts: Sequence[ChangeVerdict]) -> float | None:
        """The least compliance at the tool that the series show [mm/N]; None where none shows a stiffness."""
        shown = [one.now for verdict in verdicts for one in verdict.indicators if one.kind.name == STIFFNESS_KIND]
        stiff = [value for value in shown if value > 0]
        return 1.0 / max(stiff) if stiff else None

    def put_plan(self, machine: int, goal: NextGoal, minutes: float, instruments: Sequence[str]) -> int:
        """Ask for ways to reach a goal; the number of the job."""
        said = {**asdict(goal), "between": list(goal.between)}
        asked = {"machine": machine, "goal": said, "minutes": minutes, "instruments": list(instruments)}
        return rows.put_job(self.store, PLAN, asked, self.who)

    @staticmethod
    def next_tests_of(found: KeptJob) -> NextTests:
        """The ways that a job found.

        Raises
        ------
        InputError
            If it found none.
        """
        if found.kind != PLAN or found.state != DONE or found.result is None:
            raise InputError(f"job {found.key} has made no plan")
        return NextTests.of_document(found.result)

    def choose_plan(self, number: int, way: int, name: str, due: str = "", grace: float = 7.0) -> int:
        """Keep one of the ways that a job found as a plan of its machine, with the files of its tests.

        Parameters
        ----------
        number : int
            Of the job.
        way : int
            Which of its ways, counted from 0.
        name, due, grace
            As `keep_plan` takes them.

        Raises
        ------
        InputError
            If there is no such way, or the machine has a plan of this name.
        """
        with read(self.store) as connection:
            found = rows.kept_job(connection, number)
        ways = self.next_tests_of(found).alternatives
        if not 0 <= way < len(ways):
            raise InputError(f"this job found {len(ways)} ways, not one of number {way}; choose one of them")
        chosen = ways[way]
        document = {**chosen.plan, "files": dict(chosen.files), "for": found.asked["goal"]}
        return keep_plan(self.store, int(found.asked["machine"]), name, document, due_date(due), grace, self.who)

    def plan_to_do(self, number: int) -> PlanToDo:
        """A plan that is kept, with what it takes to do it.

        Raises
        ------
        InputError
            If there is none of this number.
        """
        plan = self._plan(number)
        said = plan.document.get("for")
        goal = None if said is None else NextGoal(**{**said, "between": tuple(said["between"])})
        return PlanToDo(plan, goal, tuple(ProgramFacts(*one) for one in plan.document.get("programs", [])))

    def plan_program(self, number: int, test: str, flavour: str) -> tuple[str, bytes]:
        """The program of a test of a plan: the name of its file, and what `elastogeo nc` writes to it.

        Raises
        ------
        InputError
            If there is no such plan, test or flavour, or the plan was kept without the files of its tests.
        PathError
            If the machine cannot make it.
        """
        return program_of(self.plan_files(number), test, flavour)

    def plan_folder(self, number: int) -> bytes:
        """The folder to measure of a plan, as a zip: its tests, and their programs for every control.

        Raises
        ------
        InputError
            If there is no such plan, or it was kept without the files of its tests.
        """
        return folder_of(self.plan_files(number))

    def plan_files(self, number: int) -> Mapping[str, str]:
        """The folder to measure of a plan: texts by their paths; empty if it was kept without."""
        files: Mapping[str, str] = self._plan(number).document.get("files", {})
        return files

    def _plan(self, number: int) -> KeptPlan:
        with read(self.store) as connection:
            found = next((one for one in plans(connection, now()) if one.key == number), None)
        if found is None:
            raise InputError(f"there is no plan {number}")
        return found

    def _jobs(self, kind: str, machine: int) -> tuple[KeptJob, ...]:
        """The last jobs of a kind of a machine, the last first."""
        with read(self.store) as connection:
            asked = select(job.c.id, job.c.asked).where(job.c.kind == kind).order_by(job.c.id.desc()).limit(_MOST_JOBS)
            keys = [row.id for row in connection.execute(asked) if row.asked.get("machine") == machine]
            return tuple(rows.kept_job(connection, key) for key in keys[:8])
