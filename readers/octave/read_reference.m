% Print case, quantity and value of a CSV file of reference values: octave-cli --no-history read_reference.m FILE.csv
1;

function stop(varargin)
  fprintf(stderr, ["read_reference: " varargin{1} "\n"], varargin{2:end});
  exit(1);
end

args = argv();
if numel(args) < 1 || (file = fopen(args{end}, "r")) < 0
  stop("cannot read the file");
end
fgetl(file);
k = 0; rows = -1;
while ischar(line = fgetl(file))
  k = k + 1;
  cells = strsplit(line, ",", "CollapseDelimiters", false);
  count = sscanf(cells{1}, "%d/%d");
  if numel(cells) != 11 || numel(cells{11}) != 64 || numel(count) != 2 || count(1) != k
    stop("row %d is damaged", k);
  end
  rows = count(2);
  value = str2double(cells{4});
  if !isreal(value) || !isfinite(value)
    stop("row %d: %s is no finite number", k, cells{4});
  end
  printf("%s,%s,%.17g\n", cells{2}, cells{3}, value);
end
if k != rows
  stop("%d rows, %d are announced", k, rows);
end
