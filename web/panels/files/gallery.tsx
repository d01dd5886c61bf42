import { Badge, Text, UnstyledButton } from "@mantine/core";
import { openExample } from "../../commands/project-actions";
import { openSolved } from "../../commands/open-solved";
import { groupModels, thumbnailOf, type GalleryModel } from "../../session/gallery";
import { SectionTitle } from "../../ui/frames/section-title";
import {
  paletteStrings,
  solvedExampleNames,
  solvedExamples,
  strings,
  type SolvedExample,
} from "../../strings";
import { useApp, useProject } from "../shared/app-context";
import { ScrollPanel } from "../../ui/frames/scroll-panel";
import styles from "./gallery.module.css";

/** The sample projects in groups, each with a picture. */
export function GalleryPanel() {
  const app = useApp();
  const name = useProject().name;
  const groups = groupModels(app.gallery.models);
  return (
    <ScrollPanel label={strings.tree.examples}>
      <Text size="sm" c="dimmed" mb="xs">
        {strings.gallery.intro}
      </Text>
      <section>
        <SectionTitle>{paletteStrings.solved}</SectionTitle>
        {solvedExampleNames.map((id) => (
          <SolvedCard key={id} id={id} current={solvedExamples[id].title === name} />
        ))}
      </section>
      {groups.map(({ title, models }) => (
        <section key={title}>
          <SectionTitle>{title}</SectionTitle>
          {models.map((model) => (
            <GalleryCard key={model.id} model={model} current={model.title === name} />
          ))}
        </section>
      ))}
    </ScrollPanel>
  );
}

interface GalleryCardProps {
  readonly model: GalleryModel;
  readonly current: boolean;
}

function GalleryCard({ model, current }: GalleryCardProps) {
  const app = useApp();
  return (
    <UnstyledButton
      className={styles["card"]}
      data-testid={`example-${model.id}`}
      data-current={current || undefined}
      onClick={() => void openExample(app, model)}
    >
      <img
        className={styles["thumbnail"]}
        src={thumbnailOf(model)}
        alt=""
        width={240}
        height={150}
        loading="lazy"
        onError={(event) => event.currentTarget.remove()}
      />
      <CardText {...model} current={current} />
    </UnstyledButton>
  );
}

interface SolvedCardProps {
  readonly id: SolvedExample;
  readonly current: boolean;
}

/** A problem that is solved when it is opened. */
function SolvedCard({ id, current }: SolvedCardProps) {
  const app = useApp();
  return (
    <UnstyledButton
      className={styles["card"]}
      data-testid={`solved-${id}`}
      data-current={current || undefined}
      onClick={() => void openSolved(app, id)}
    >
      <CardText {...solvedExamples[id]} current={current} />
    </UnstyledButton>
  );
}

interface CardTextProps {
  readonly title: string;
  readonly blurb: string;
  readonly current: boolean;
}

function CardText({ title, blurb, current }: CardTextProps) {
  return (
    <>
      <span className={styles["head"]}>
        <Text fw={600} size="sm" component="span">
          {title}
        </Text>
        {current && (
          <Badge size="sm" variant="outline" color="var(--tf-accent)" tt="none">
            {strings.gallery.current}
          </Badge>
        )}
      </span>
      <Text size="sm" c="dimmed" component="span" className={styles["blurb"]}>
        {blurb}
      </Text>
    </>
  );
}
