import { IconPlus, IconTrash } from "@tabler/icons-react";
import { useContext, useRef, useState, type KeyboardEvent } from "react";
import { TextInput } from "@mantine/core";
import type { ProjectParameter } from "tetrafront/project";
import {
  addParameter,
  expressionProblem,
  freeName,
  nameProblem,
  removeParameter,
  renameParameter,
  renameProblem,
  setParameter,
  usesOf,
} from "../../document/parameters";
import { NameField } from "../../ui/fields/name-field";
import { NamedNumbersContext } from "../../ui/fields/named-numbers";
import { formatNumber } from "../../strings/format";
import { SectionTitle } from "../../ui/frames/section-title";
import { IconButton } from "../../ui/icon-button";
import { strings } from "../../strings";
import { useApp, useProject } from "../shared/app-context";
import styles from "./parameter-table.module.css";

const texts = strings.parameters;

/** The parameters of the project: names, expressions and values. */
export function ParameterTable() {
  const { parameters = [] } = useProject();
  return (
    <section data-testid="parameters">
      <SectionTitle>{texts.title}</SectionTitle>
      <table className={styles["table"]}>
        <thead>
          <tr>
            <th scope="col">{texts.name}</th>
            <th scope="col" title={texts.hint}>
              {texts.expression}
            </th>
            <th scope="col">{texts.value}</th>
            <td />
          </tr>
        </thead>
        <tbody>
          {parameters.map((parameter, index) => (
            <ParameterRow key={index} parameter={parameter} />
          ))}
          <NewParameterRow />
        </tbody>
      </table>
      {parameters.length === 0 && <p className={styles["hint"]}>{texts.hint}</p>}
    </section>
  );
}

function ParameterRow({ parameter: { name, expression } }: { readonly parameter: ProjectParameter }) {
  const { documents } = useApp();
  const project = useProject();
  const value = useContext(NamedNumbersContext).get(name);
  return (
    <tr title={`${name}: ${texts.uses(usesOf(project, name).length)}`}>
      <td>
        <NameField
          label={texts.nameOf(name)}
          value={name}
          placeholder={name}
          testId={`parameter-name-${name}`}
          refuse={(next) => renameProblem(project, name, next)}
          onCommit={(next) => documents.edit(renameParameter(name, next))}
        />
      </td>
      <td>
        <NameField
          label={texts.expressionOf(name)}
          value={expression}
          placeholder={expression}
          testId={`parameter-${name}`}
          refuse={(next) => expressionProblem(project, name, next)}
          onCommit={(next) => documents.edit(setParameter(name, next))}
        />
      </td>
      <td className={styles["value"]} data-testid={`parameter-value-${name}`}>
        {value === undefined ? texts.noValue : formatNumber(value)}
      </td>
      <td>
        <IconButton
          label={texts.remove(name)}
          size={28}
          onClick={() => documents.edit(removeParameter(project, name))}
        >
          <IconTrash size={15} aria-hidden />
        </IconButton>
      </td>
    </tr>
  );
}

/** Two fields whose texts become a parameter on Enter; the next one can then be typed. */
function NewParameterRow() {
  const { documents } = useApp();
  const project = useProject();
  const [typed, setTyped] = useState({ name: "", expression: "" });
  const [problem, setProblem] = useState<{
    readonly name: string | null;
    readonly expression: string | null;
  }>({
    name: null,
    expression: null,
  });
  const first = useRef<HTMLInputElement>(null);
  const second = useRef<HTMLInputElement>(null);
  const add = (): void => {
    const name = typed.name.trim() === "" ? freeName(project) : typed.name.trim();
    const found = {
      name: nameProblem(project, name),
      expression: expressionProblem(project, name, typed.expression),
    };
    setProblem(found);
    if (found.name !== null || found.expression !== null) return;
    documents.edit(addParameter(name, typed.expression));
    setTyped({ name: "", expression: "" });
    first.current?.focus();
  };
  const onKeyDown = (event: KeyboardEvent): void => {
    if (event.key === "Enter") add();
  };
  const field = (key: "name" | "expression", label: string) => ({
    size: "xs",
    "aria-label": label,
    autoComplete: "off",
    spellCheck: false,
    "data-testid": `new-parameter-${key}`,
    value: typed[key],
    error: problem[key],
    onKeyDown,
    onChange: ({ currentTarget: { value } }: { readonly currentTarget: { readonly value: string } }) => {
      setProblem({ name: null, expression: null });
      const [name = "", expression] = value.split(/=(.*)/s);
      if (expression === undefined || (key === "expression" && typed.name !== "")) {
        return setTyped({ ...typed, [key]: value });
      }
      // An equation, such as `r = 0.3`, in one of the fields is divided between both. Without a right side, as in `r =`, the
      // expression that the other field has stays.
      const other = key === "name" ? typed.expression : "";
      setTyped({ name: name.trim(), expression: expression.trim() || other });
      second.current?.focus();
    },
  });
  return (
    <tr>
      <td>
        <TextInput ref={first} placeholder={freeName(project)} {...field("name", texts.newName)} />
      </td>
      <td>
        <TextInput ref={second} {...field("expression", texts.newExpression)} />
      </td>
      <td />
      <td>
        <IconButton label={texts.add} size={28} onClick={add}>
          <IconPlus size={15} aria-hidden />
        </IconButton>
      </td>
    </tr>
  );
}
