import { Button, Tooltip } from "@mantine/core";
import { IconWand } from "@tabler/icons-react";
import { applyFixes, fixesOf } from "../../commands/fix-actions";
import type { Problem } from "../../document/validate";
import { fixStrings } from "../../strings";
import { useApp } from "../shared/app-context";

/** A button that solves a problem, if there is a safe way. Its hint says what it will do. */
export function FixButton({ problem }: { readonly problem: Problem }) {
  const app = useApp();
  const [fix] = fixesOf(app, [problem]);
  if (!fix) return null;
  return (
    <Tooltip label={fix.effect} multiline maw={280} openDelay={200}>
      <Button
        size="compact-xs"
        variant="light"
        leftSection={<IconWand size={13} aria-hidden />}
        aria-description={fix.effect}
        data-testid={`fix-${problem.code}`}
        onClick={() => applyFixes(app, fixesOf(app, [problem]))}
      >
        {fix.label}
      </Button>
    </Tooltip>
  );
}

/** A button that solves all problems of one kind, in one step of undo. */
export function FixAllButton({ problems }: { readonly problems: readonly Problem[] }) {
  const app = useApp();
  const fixes = problems.length > 1 ? fixesOf(app, problems) : [];
  const [first] = fixes;
  if (!first || fixes.length < 2 || first.cover !== null) return null;
  return (
    <Tooltip label={fixStrings.fixAllEffect(first.effect)} multiline maw={280} openDelay={200}>
      <Button
        size="compact-xs"
        variant="light"
        leftSection={<IconWand size={13} aria-hidden />}
        aria-description={fixStrings.fixAllEffect(first.effect)}
        data-testid={`fix-all-${problems[0]?.code ?? ""}`}
        onClick={() => applyFixes(app, fixesOf(app, problems))}
      >
        {fixStrings.fixAll(fixes.length)}
      </Button>
    </Tooltip>
  );
}
