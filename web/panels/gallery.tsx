import { Badge, Text, UnstyledButton } from "@mantine/core";
import { openExample } from "../actions";
import { strings } from "../ui/strings";
import { useApp, useProject } from "./app-context";

/** The bundled sample projects. */
export function GalleryPanel() {
  const app = useApp();
  const name = useProject().name;
  return (
    <div className="tf-scroll tf-pad" tabIndex={0} aria-label={strings.tree.examples} role="region">
      <Text size="sm" c="dimmed" mb="xs">
        {strings.gallery.intro}
      </Text>
      {app.gallery.models.map((model) => (
        <UnstyledButton
          key={model.id}
          className="tf-card"
          data-testid={`example-${model.id}`}
          data-current={model.title === name || undefined}
          onClick={() => void openExample(app, model)}
        >
          <span className="tf-card-head">
            <Text fw={600} size="sm" component="span">
              {model.title}
            </Text>
            {model.title === name && (
              <Badge size="sm" variant="outline" color="var(--tf-accent)" tt="none">
                {strings.gallery.current}
              </Badge>
            )}
          </span>
          <Text size="sm" c="dimmed" component="span">
            {model.blurb}
          </Text>
        </UnstyledButton>
      ))}
    </div>
  );
}
